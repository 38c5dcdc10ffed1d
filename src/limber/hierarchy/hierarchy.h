// SPDX-License-Identifier: Apache-2.0
// The multilevel mesh without positions (Kircher & Garland 2005, section 3): levels of nodes in one
// numbering, finest first, and a parent for every node below the top. A cluster is the children of a node.
// Part of the player: standard library only.
//
//   level 2 (top)            o9          o10        level_begin = {0, 6, 9, 11}
//                           /  \          |         parent      = {6, 6, 7, 7, 8, 8,  9, 9, 10,  -, -}
//   level 1              o6     o7       o8
//                       / \    / \      / \         '-' is kNone
//   level 0 (finest)   o0 o1  o2 o3    o4 o5
#pragma once

#include <cassert>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

// The unit of everything that changes: `node` leaves its cluster and becomes a child of `parent`, which lies
// one level above it.
struct Swap {
  Index node = kNone;
  Index parent = kNone;

  friend bool operator==(const Swap&, const Swap&) = default;
};

// Invariants, by name (see docs/design.md; validate() in hierarchy/validate.h checks them from scratch):
//   levels-nested       level_begin starts at 0, never decreases, and ends at the node count
//   parent-one-above    the parent of a node below the top lies exactly one level above it
//   top-has-no-parent   parents of the top level are kNone
//   cluster-not-empty   every node above the finest level has a child
//   cluster-connected   every node stands for a connected set of finest vertices
//   manifold-kept       (only where promised) every level is homeomorphic to the finest
struct Hierarchy {
  std::vector<Index> level_begin;  // [level_count + 1]
  std::vector<Index> parent;       // [node_count]

  Index level_count() const { return static_cast<Index>(level_begin.size()) - 1; }
  Index node_count() const { return level_begin.back(); }
  Index level_size(Index level) const { return level_begin[level + 1] - level_begin[level]; }
  // The number of finest vertices.
  Index vertex_count() const { return level_begin[1]; }

  Index level_of(Index node) const {
    assert(node < node_count());
    Index level = 0;
    while (node >= level_begin[level + 1]) ++level;
    return level;
  }

  friend bool operator==(const Hierarchy&, const Hierarchy&) = default;
};

// Precondition: swap.node is below the top and swap.parent one level above it.
inline void apply(Hierarchy& hierarchy, const Swap& swap) { hierarchy.parent[swap.node] = swap.parent; }

}  // namespace limber
