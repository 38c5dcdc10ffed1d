// SPDX-License-Identifier: Apache-2.0
// Which swaps are allowed (Kircher & Garland 2005, sections 4.2 and 4.3), and which births and deaths of clusters.
#pragma once

#include "limber/contract/contract.h"
#include "limber/hierarchy/child_lists.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/level_graph.h"

namespace limber {

class SwapValidity {
 public:
  // All of them must outlive this object, and children must follow the hierarchy.
  SwapValidity(const Hierarchy& hierarchy, const ChildLists& children, Topology topology)
      : hierarchy_(hierarchy), children_(children), topology_(topology) {}

  // Whether `node`, which lies on the level of `graph`, may leave its cluster for `to`: the parent of a neighbour.
  // At this level and at all coarser ones, up to the first cluster that holds both, every cluster must stay
  // connected, and with Topology::kPreserve every level must stay homeomorphic to what it was.
  // Precondition: `to` lies one level above node and is not its parent.
  bool operator()(const LevelGraph& graph, Index node, Index to);

  // The same where `node` is all that its cluster has, which ends by that.
  bool may_end(const LevelGraph& graph, Index node, Index to);

  // Whether `node` may leave its cluster and be a new one, with the parent of the old one.
  bool may_found(const LevelGraph& graph, Index node);

 private:
  bool is_swappable(const LevelGraph& graph, Index node) const;
  bool is_valid_from(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up);
  bool find_runs(const LevelGraph& graph, Index node, Index levels_up);
  bool keeps_homeomorphism(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up);
  bool touches_beyond_runs(const LevelGraph& graph, Index cluster, Index except) const;
  bool leaves_surface(const LevelGraph& graph, Index node) const;
  bool keeps_contacts(const LevelGraph& graph, Index node, Index from, Index to, Index levels_up);
  bool keeps_connection(const LevelGraph& graph, Index node, Index from, Index levels_up);
  bool is_beside(const LevelGraph& graph, Index node, Index cluster, Index levels_up, Index except = kNone) const;
  bool are_joined(const LevelGraph& graph, Index cluster, Index other, Index levels_up, Index except) const;
  Index ancestor(Index node, Index levels_up) const {
    for (; levels_up > 0; --levels_up) node = hierarchy_.parent[node];
    return node;
  }
  // visit(node on the level of the graph) for what a cluster holds; stops when visit gives true, and then gives true.
  template <class Visit>
  bool any_of(Index cluster, Index levels_down, Visit&& visit) const;

  const Hierarchy& hierarchy_;
  const ChildLists& children_;
  Topology topology_;
  std::vector<Index> runs_;     // scratch: labels around the node, one for each run; kNone is the outside
  std::vector<Index> reached_;  // scratch of the search for connection
  std::vector<Index> mark_;
  Index stamp_ = 0;
};

}  // namespace limber
