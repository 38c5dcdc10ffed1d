// SPDX-License-Identifier: Apache-2.0
// Swaps that turn triangles of a level back which face away from the surface: quadrics do not see which way a triangle
// faces. Neither paper has it.
#pragma once

#include <algorithm>
#include <vector>

#include "limber/hierarchy/change_budget.h"
#include "limber/hierarchy/clustering.h"
#include "limber/hierarchy/level_graph.h"
#include "limber/hierarchy/swap_validity.h"
#include "limber/hierarchy/worth.h"

namespace limber {

// Keeps its scratch memory between calls.
class Unfolder {
 public:
  // All of them must outlive this object.
  Unfolder(Clustering& clusters, SwapValidity& is_valid, const Worth& worth, ChangeBudget& budget)
      : clusters_(clusters),
        is_valid_(is_valid),
        worth_(worth),
        budget_(budget),
        left_(clusters.hierarchy().node_count(), kNone) {}

  // For each triangle of the level above `graph` that is turned over at the minima of its corners (base/facing.h): the
  // swap of a node of `graph` that costs least, no more than `most`, and leaves fewer such triangles.
  void unfold(const LevelGraph& graph, double most);

  // Moves a node of the graph. False, and all is as before, where the budget does not allow it, or where the node would
  // go back to where unfold() last took it from, and more triangles would be turned over.
  bool move(const LevelGraph& graph, Index node, Index to);

  // Where unfold() has taken nodes from: for a hierarchy made anew.
  void forget() { std::ranges::fill(left_, kNone); }

 private:
  struct Candidate {
    double cost;
    Index node, to;
  };

  bool is_over(Index a, Index b, Index c) const;
  Index first_neighbour_in(const LevelGraph& graph, Index node, Index cluster) const;
  bool is_corner(const LevelGraph& graph, Index node, const Triangle& triangle) const;
  Index count_turned_over(const LevelGraph& graph, Index cluster, Index except) const;
  Index count_around(const LevelGraph& graph, Index a, Index b) const;
  void consider(const LevelGraph& graph, Index node, Index to, const Triangle& triangle, double most);
  void find_candidates(const LevelGraph& graph, const Triangle& triangle, double most);
  bool move_if_fewer(const LevelGraph& graph, Index node, Index to, Index below);
  void turn_back(const LevelGraph& graph, const Triangle& triangle, double most);

  Clustering& clusters_;
  SwapValidity& is_valid_;
  const Worth& worth_;
  ChangeBudget& budget_;
  std::vector<Index> left_;          // [node_count]: the cluster that the node was last taken from
  std::vector<Triangle> triangles_;  // scratch: of the level
  std::vector<Candidate> candidates_;
};

}  // namespace limber
