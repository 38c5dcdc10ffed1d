// SPDX-License-Identifier: Apache-2.0
// Simplification by four-face clusters, which is the construction of a 4-K mesh (Velho 2001).
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "limber/contract/contraction.h"
#include "limber/fourface/cluster.h"
#include "limber/fourface/four_k_mesh.h"

namespace limber {

struct FourKOptions {
  ClusterOptions cluster{};
  QuadricOptions quadrics{};
  // A level ends where so many of its triangles are left, as a share, unless what follows costs nothing; 0: where no
  // cluster is left that may still be simplified, as in the paper.
  double level_share = 0.7;
  // How many clusters may depend on each other in a row, per level on average, at least 1.
  double clusters_per_level = 2;
  // The longest chain of operations that depend on each other has at most so many times the binary logarithm of the
  // number of triangles; what comes close to that costs more. 0: as long as it gets. With may_fold it is let go of
  // where nothing else is left.
  double height = 2.5;
  // Of several frames: ClusterOptions::fold_over_cosine is at most this. A triangle that turns in one frame of many
  // must not keep all the others from what is best for them.
  double many_fold_over_cosine = 0.2;
  // Where it ends: at so many vertices, triangles or levels.
  Index vertices = 0;
  Index triangles = 0;
  Index levels = 250;     // 1 to 250
  bool may_fold = false;  // whether clusters that fold over are simplified where nothing else is left
  unsigned threads = 1;   // the result is the same for every number, >= 1
};

// What the simplification keeps: vertices, and edges as lines (creases, seams), along which alone their vertices are
// removed. Borders are lines anyway.
struct FourKTags {
  std::vector<Index> vertices;
  std::vector<std::array<Index, 2>> edges;
};

// positions: [mesh.vertex_count], finite. go_on: as in contract.h; where it gives false the result is incomplete.
FourKMesh build_four_k(const Mesh& mesh, std::span<const Vec3f> positions, const FourKOptions& options,
                       const FourKTags& tags = {}, GoOnFunction go_on = {});

// The same for all frames together: costs are their sums. frames: at least one. The errors are of all frames, the
// spheres of the first: for those of a frame see measure_frame().
FourKMesh build_four_k(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames, const FourKOptions& options,
                       const FourKTags& tags = {}, GoOnFunction go_on = {});

}  // namespace limber
