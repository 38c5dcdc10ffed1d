// SPDX-License-Identifier: Apache-2.0
// What it takes to remove a vertex: which swaps make its faces four, and which neighbour is kept (Velho 2001, steps 1
// and 3).
#pragma once

#include <array>
#include <cstdint>

#include "limber/fourface/face_table.h"
#include "limber/fourface/vertex_errors.h"

namespace limber {

struct ClusterOptions {
  double removal_weight = 1;    // alpha, of C(v), the quadric error at the neighbour that is kept, >= 0
  double swap_weight = 5;       // beta, of S(v), what the swaps cost, >= 0
  double shape_weight = 0.001;  // of badly shaped triangles, >= 0 (docs/design.md, "Four-face clusters")
  // A swap costs so much more, as a share, for each operation that its faces depend on in a row beyond the fewest
  // around the vertex, >= 0.
  double chain_weight = .35;
  // A new triangle may turn from those that it replaces by an angle with this cosine, but never from the input's
  // surface around its corners (VertexErrors::faces_outwards); both rules are off where it is -1 or less.
  double fold_over_cosine = 0.5;
};

// All that a plan looks at; the costs are sums over all frames, and none may fold over.
struct ClusterInput {
  const FaceTable& faces;
  const VertexErrors& errors;
};

struct ClusterPlan {
  static constexpr std::uint32_t kMostSwaps = 12;  // vertices that take more are not removed, for now

  // E(v) = alpha C(v) + beta S(v), and the term of the shape; >= 0.
  float cost;
  Index kept_vertex;         // u, the neighbour that is kept
  std::uint16_t operations;  // that depend on each other in a row, with the removal itself, the last
  // Places in the star's ring: of u; of the other end w of the new edge, or u's own where
  // there is none, as v has three faces; of the far ends of the edges that are swapped, in order.
  std::uint8_t kept, opposite, swap_count;
  std::array<std::uint8_t, kMostSwaps> swaps;
};

// The cheapest way of removing star.center that folds nothing over, creates no edge that is there already, and keeps
// lines: a vertex on a line is removed along it, and one where lines end or meet is not. False: there is none.
bool plan_cluster(const ClusterInput& input, const Star& star, const ClusterOptions& options, ClusterPlan& plan);

// Whether none of the edges that the plan for the star creates is there already, as none was when it was made.
bool creates_new_edges(const FaceTable& faces, const Star& star, const ClusterPlan& plan);

}  // namespace limber
