// SPDX-License-Identifier: Apache-2.0
// The children of every node, as linked lists that follow swaps in constant time. Part of the player.
#pragma once

#include <algorithm>
#include <vector>

#include "limber/hierarchy/hierarchy.h"

namespace limber {

class ChildLists {
 public:
  // No node has a child.
  explicit ChildLists(Index node_count)
      : first_child_(node_count, kNone), next_(node_count, kNone), previous_(node_count, kNone) {}

  explicit ChildLists(const Hierarchy& hierarchy) : ChildLists(hierarchy.node_count()) {
    for (Index node = hierarchy.node_count(); node-- > 0;)
      if (hierarchy.parent[node] != kNone) add(node, hierarchy.parent[node]);
  }

  // kNone for finest vertices and after the last sibling.
  Index first_child(Index node) const { return first_child_[node]; }
  Index next_sibling(Index node) const { return next_[node]; }

  // for (const Index child : lists.of(node)): the lists must not change meanwhile.
  class Children {
   public:
    class Iterator {
     public:
      Iterator(const ChildLists& lists, Index node) : lists_(&lists), node_(node) {}
      Index operator*() const { return node_; }
      Iterator& operator++() {
        node_ = lists_->next_[node_];
        return *this;
      }
      bool operator!=(const Iterator& o) const { return node_ != o.node_; }

     private:
      const ChildLists* lists_;
      Index node_;
    };

    Children(const ChildLists& lists, Index node) : lists_(lists), node_(node) {}
    Iterator begin() const { return {lists_, lists_.first_child_[node_]}; }
    Iterator end() const { return {lists_, kNone}; }

   private:
    const ChildLists& lists_;
    Index node_;
  };
  Children of(Index node) const { return {*this, node}; }

  // Precondition: `node` is the child of none.
  void add(Index node, Index parent) {
    Index& first = first_child_[parent];
    next_[node] = first;
    previous_[node] = kNone;
    if (first != kNone) previous_[first] = node;
    first = node;
  }

  // Precondition: `node` is a child of `from`.
  void move(Index node, Index from, Index to) {
    (previous_[node] == kNone ? first_child_[from] : next_[previous_[node]]) = next_[node];
    if (next_[node] != kNone) previous_[next_[node]] = previous_[node];
    add(node, to);
  }

  // Again no node has a child.
  void clear() { std::fill(first_child_.begin(), first_child_.end(), kNone); }

 private:
  std::vector<Index> first_child_;      // [node_count]
  std::vector<Index> next_, previous_;  // [node_count]; of children only
};

}  // namespace limber
