// SPDX-License-Identifier: Apache-2.0
// A level of detail: exactly one active node on every path from a finest vertex to the top.
// Part of the player: standard library only.
//
//   level 2 (top)     (o9)         [o10]        ( ) expanded: its children stand for it
//                     /  \           |          [ ] active: drawn as one vertex
//   level 1        [o6]  (o7)       o8
//                  / \    / \       / \         label of o0 and o1 is o6, of o2 and o3 themselves,
//   level 0      o0 o1 [o2][o3]   o4  o5        of o4, o5 and o8 o10, of o9 and o7 kNone
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/stream/frame_state.h"
#include "limber/view/budget.h"
#include "limber/view/drawn_witnesses.h"
#include "limber/view/node_errors.h"
#include "limber/view/seen_weights.h"
#include "limber/view/stars.h"
#include "limber/view/view.h"
#include "limber/view/witnesses.h"

namespace limber {

enum class CutBy {
  kLevel,      // the nodes of one level
  kVertices,   // at most so many vertices, and the least error that they allow
  kTriangles,  // at most so many triangles, and the least error that they allow
  kError,      // the coarsest nodes whose distance from the surface they stand for is within a bound
};

struct CutOptions {
  CutBy by = CutBy::kLevel;
  Index level = 0;          // kLevel: 0 is the finest; clamped to the top
  Index budget = 0;         // kVertices, kTriangles
  float error_bound = 1;    // kError: percent of the bounding box diagonal of the frame, with a view in its unit, >= 0
  float hysteresis = 1.6f;  // >= 1: how many times better, in squared error, a change must be
  bool hold = true;         // kError, with a view: see below; otherwise its errors are estimates
  float enough = 0;         // kVertices, kTriangles, with a view: what no budget is spent on going below, in its unit
};

// Budgets. The total squared error of the active nodes is made as small as the budget allows (see budget.h). Nothing is
// coarser than the top level: a budget below that gives the top level. A vertex budget counts active nodes that can
// have a triangle: not those that stand for isolated vertices alone (corners of no triangle that has three different
// ones), nor those that stand for a whole connected part of the mesh. A triangle budget counts triangles
// as list_triangles() finds them, before it makes equal ones one.
//
// Error bound. A node is contracted where errors[n] / sqrt(area) is within the bound: the root of the mean squared
// distance over the area that the node stands for at this frame, a third of each finest triangle going to each corner.
//
// Looked at with a view (view.h) the same criteria mean something else. A budget makes the largest error that is seen
// as small as it can: nodes are expanded from the largest estimated error down. An error bound is in the unit of the
// view, and with `hold` it is measured, not estimated: after update(mesh, state, view)
//
//   every finest vertex and every middle of a finest side is within half of the bound of a triangle that is drawn,
//   every drawn node, middle of a drawn side and centre of a drawn triangle is within half of it of the finest surface,
//
// where distances count as much as the view says at that place (for drawn nodes, as at the finest vertex below them
// that counts most). The other half of the bound is for what lies between these samples; limber_screen_bench measures
// how much of it that takes. Without `hold` all errors are estimates (node_errors.h), and an update is many times
// faster. Where the view allows more, as outside the picture, that much more is promised. Isolated vertices are not.
//
// Hysteresis. Between frames a node that was expanded outranks one that was not unless the latter would gain more
// than `hysteresis` times as much squared error per vertex or triangle; under an error bound it stays expanded until
// its squared error is within that of the bound / hysteresis. Budgets and bounds always hold. With hysteresis 1 a cut
// depends on its frame alone, but with a view on what was measured before, too.
class Cut {
 public:
  // Allocates all that updates need. `hierarchy` is any frame's of the clip: level sizes do not change.
  // Precondition: fewer than 2^31 nodes.
  Cut(const Mesh& mesh, const Hierarchy& hierarchy, const CutOptions& options);

  // Takes effect at the next update, and may allocate. That update still has the hysteresis of the cut so far.
  // Preconditions here and above: hysteresis >= 1, error_bound >= 0.
  void set_options(const CutOptions& options);
  const CutOptions& options() const { return options_; }

  // Makes the cut of this frame. Any frame may follow any other. Does not allocate.
  // Precondition: the mesh and the level sizes that the cut was made with.
  void update(const Mesh& mesh, const FrameState& state);

  // The same as it is looked at. The first call allocates.
  void update(const Mesh& mesh, const FrameState& state, const View& view);

  // After an update with a view: where the bound is held, a bound of what is seen (at most that asked for); otherwise
  // the largest estimate of an active node. In the unit of the view.
  float seen_error() const;

  // [node_count]: the active node on the path from a node to the top, the node itself included; kNone for a node
  // above the cut. Finest vertices (the first vertex_count) always have one.
  std::span<const Index> labels() const { return labels_; }
  bool is_active(Index node) const { return labels_[node] == node; }
  // Whether a node lies above the cut.
  bool is_expanded(Index node) const { return labels_[node] == kNone; }

  // The number of active nodes that can have a triangle, as a vertex budget counts them: no less, and hardly ever more,
  // than the vertices of the extracted mesh.
  Index vertex_count() const { return vertex_count_; }

 private:
  void find_parts(const Mesh& mesh);
  void count_finest_children(const Hierarchy& hierarchy);
  void count_children(const Hierarchy& hierarchy);
  void find_drawn(const Hierarchy& hierarchy);
  void find_drawn_among_parts(const Hierarchy& hierarchy);
  std::uint32_t price_vertices(const Hierarchy& hierarchy);
  std::uint32_t price_triangles(const Mesh& mesh, const Hierarchy& hierarchy);
  void expand_down_to_level(const Hierarchy& hierarchy);
  void expand_by_error(const Mesh& mesh, const FrameState& state);
  void expand_by_seen_error(float limit);
  void hold(const Mesh& mesh, const FrameState& state, float limit);
  bool expand_around(const Mesh& mesh, const Hierarchy& hierarchy, Index vertex);
  void relabel_vertices(const Hierarchy& hierarchy);
  void label_nodes(const Hierarchy& hierarchy);
  void count_vertices(const Hierarchy& hierarchy);

  CutOptions options_;
  Budget budget_;
  Index vertex_count_ = 0;
  std::vector<Index> labels_;  // [node_count]

  // Of the mesh: a part is what triangles connect.
  std::vector<std::uint8_t> has_surface_;  // [mesh.vertex_count]: a triangle that is not degenerate has it as a corner
  std::vector<Index> part_size_;           // [mesh.vertex_count]: how many of them the vertex's part has
  Index largest_part_ = 0;
  bool has_parts_ = false;  // more than one with surface
  std::size_t triangle_count_ = 0;

  // Of the frame: [node_count - vertex_count], coarse node n at n - vertex_count.
  std::vector<std::uint8_t> expanded_;  // all that is kept from frame to frame
  std::vector<std::uint32_t> surface_children_;
  std::vector<Index> counted_parents_;         // [vertex_count]: the parents that surface_children_ was counted with
  std::vector<std::uint32_t> vertices_below_;  // with surface
  std::vector<Index> part_size_below_;
  std::vector<std::uint8_t> is_drawn_;  // can have a triangle while active
  std::vector<std::uint32_t> price_;

  std::vector<double> area_;      // [node_count], for an error bound
  std::vector<Triangle> images_;  // [triangle_count_], for a triangle budget

  struct Looking {  // all that a view needs
    Looking(const Mesh& mesh, const Hierarchy& hierarchy)
        : stars(mesh),
          errors(hierarchy),
          witnesses(mesh),
          drawn_witnesses(mesh, hierarchy),
          has_changed(mesh.vertex_count) {}

    Stars stars;
    SeenWeights weights;
    NodeErrors errors;
    Witnesses witnesses;
    DrawnWitnesses drawn_witnesses;
    std::vector<std::uint8_t> has_changed;  // [vertex_count]: scratch of hold()
    float seen_error = 0;
  };
  std::optional<Looking> looking_;
};

}  // namespace limber
