// SPDX-License-Identifier: Apache-2.0
// The children of every node, as linked lists that follow swaps in constant time.
#pragma once

#include <vector>

#include "limber/hierarchy/hierarchy.h"

namespace limber {

class ChildLists {
 public:
  explicit ChildLists(const Hierarchy& hierarchy)
      : first_child_(hierarchy.node_count(), kNone),
        next_(hierarchy.node_count(), kNone),
        previous_(hierarchy.node_count(), kNone) {
    for (Index node = hierarchy.node_count(); node-- > 0;)
      if (hierarchy.parent[node] != kNone) link(node, hierarchy.parent[node]);
  }

  // kNone for finest vertices and after the last sibling.
  Index first_child(Index node) const { return first_child_[node]; }
  Index next_sibling(Index node) const { return next_[node]; }

  // Precondition: `node` is a child of `from`.
  void move(Index node, Index from, Index to) {
    (previous_[node] == kNone ? first_child_[from] : next_[previous_[node]]) = next_[node];
    if (next_[node] != kNone) previous_[next_[node]] = previous_[node];
    link(node, to);
  }

 private:
  void link(Index node, Index parent) {
    next_[node] = first_child_[parent];
    previous_[node] = kNone;
    if (next_[node] != kNone) previous_[next_[node]] = node;
    first_child_[parent] = node;
  }

  std::vector<Index> first_child_, next_, previous_;  // [node_count]
};

}  // namespace limber
