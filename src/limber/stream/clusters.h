// SPDX-License-Identifier: Apache-2.0
// The hierarchy while its changes are coded: parents with lists of children, and the clusters that lie beside a
// node's. Part of the player.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/hierarchy/child_lists.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/stream/neighbors.h"

namespace limber {

// A cluster beside a node, and how many of the finest edges looked at lead from the node's vertices into it.
struct Candidate {
  Index parent;
  std::uint32_t edge_count;
};

class Clusters {
 public:
  // Both must live as long as this.
  Clusters(std::span<const Index> level_begin, const IndexLists& neighbors);

  std::span<const Index> level_begin() const { return level_begin_; }
  std::span<const Index> parents() const { return parent_; }

  bool has_children(Index node) const { return children_.first_child(node) != kNone; }

  // No node has a parent.
  void clear();

  // Precondition of both: swap.node is below the top and swap.parent one level above it; the node has no parent
  // (place), or has one (apply).
  void place(const Swap& swap);
  void apply(const Swap& swap);

  // By node less the number of finest vertices: whether apply() took a child or gave one since the last call of
  // clear() or forget_changes().
  std::span<const std::uint8_t> changed() const { return changed_; }
  void forget_changes();

  // The clusters of a node's level, other than its own, that a finest edge joins to it: those with the most edges
  // first, then the lower. Of a coarse node a few vertices are looked at (docs/format.md). Valid until the next call.
  // `own_edge_count`: edges to the rest of its own cluster. Precondition: below `level` every node has a parent.
  std::span<const Candidate> candidates(Index level, Index node, std::uint32_t& own_edge_count);

 private:
  std::span<const Index> level_begin_;
  const IndexLists& neighbors_;
  std::vector<Index> parent_;  // [node_count]
  ChildLists children_;
  std::vector<Candidate> candidates_;
  std::vector<std::uint8_t> changed_;
};

}  // namespace limber
