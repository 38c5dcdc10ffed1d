// SPDX-License-Identifier: Apache-2.0
// The vertex hierarchy of one frame, and whether a set of vertices is one of its nodes (Day 1985, "Optimal algorithms
// for comparing trees with labeled leaves").
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "eval/methods/feature_contraction.h"
#include "limber/base/mesh.h"

namespace limber::eval {

// A node is the set of the vertices below it: two hierarchies of one mesh have a node in common where both have that
// set, whatever their nodes are numbered.
class Forest {
 public:
  // What is_node() has to know of a set of vertices: the vertices stand in an order in which those of every node are
  // next to each other.
  struct Footprint {
    Index first, last;  // places in the order
    Index count;
  };
  // Of the union of two sets that have no vertex in common.
  static Footprint join(const Footprint& a, const Footprint& b) {
    return {std::min(a.first, b.first), std::max(a.last, b.last), a.count + b.count};
  }

  // Every vertex by itself.
  explicit Forest(Index vertex_count);
  // What contractions, in their order, put together.
  Forest(Index vertex_count, std::span<const FeatureContraction::Merge> merges);
  // parent: [node count], kNone for roots; the vertices are the first nodes, and every node is before its parent.
  Forest(Index vertex_count, std::vector<Index> parent);

  Index vertex_count() const { return static_cast<Index>(place_.size()); }
  Index node_count() const { return static_cast<Index>(parent_.size()); }
  Index parent(Index node) const { return parent_[node]; }

  Footprint footprint(Index vertex) const { return {place_[vertex], place_[vertex], 1}; }
  bool is_node(const Footprint& set) const {
    return set.last - set.first + 1 == set.count &&
           (largest_from_[set.first] == set.last || largest_to_[set.last] == set.first);
  }

 private:
  std::vector<Index> parent_;
  std::vector<Index> place_;         // [vertex_count]
  std::vector<Index> largest_from_;  // [vertex_count]: where the largest node ends that begins at a place
  std::vector<Index> largest_to_;    // [vertex_count]: where the largest node begins that ends at a place
};

}  // namespace limber::eval
