// SPDX-License-Identifier: Apache-2.0
// How many triangles of each level may be new in a frame.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "limber/hierarchy/clustering.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/level_graph.h"

namespace limber {

// Counts the triangles that moves make, each as often as it is made: at least as many as are new in the end.
class ChangeBudget {
 public:
  // Without limits so far. The hierarchy must outlive this object.
  explicit ChangeBudget(const Hierarchy& hierarchy)
      : hierarchy_(hierarchy), left_(hierarchy.level_count(), kUnlimited), kept_(left_) {}

  // Begins a frame. graphs: [level_count], as they are before anything is moved; share: of the triangles of each level,
  // >= 0.
  void limit(std::span<const LevelGraph> graphs, double share);
  bool is_limited() const { return !left_.empty() && left_.back() != kUnlimited; }

  // Moves a node of the graph. False, and all is as before, where a level cannot afford that. `clusters` has the
  // hierarchy.
  bool move(Clustering& clusters, const LevelGraph& graph, Index node, Index to);

  // What is spent after keep() is given back by undo().
  void keep() { kept_ = left_; }
  void undo() { left_ = kept_; }

 private:
  static constexpr Index kUnlimited = std::numeric_limits<Index>::max();

  Index count_made(const LevelGraph& graph, Index node, Index label);
  // The node of the graph has just left the cluster `from`. False, and nothing is spent, where a level cannot afford
  // that.
  bool spend(const LevelGraph& graph, Index node, Index from);

  const Hierarchy& hierarchy_;
  std::vector<Index> left_, kept_;           // [level_count]
  std::vector<Index> around_;                // scratch: the labels around the node, on the level at work
  std::vector<std::array<Index, 2>> sides_;  // scratch: of the triangles made
  std::vector<Index> made_;                  // scratch: on each level from that of the clusters on
};

}  // namespace limber
