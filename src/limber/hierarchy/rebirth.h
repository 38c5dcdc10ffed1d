// SPDX-License-Identifier: Apache-2.0
// Births and deaths of clusters, which Kircher & Garland 2005 name as future work: a cluster that is hardly missed
// ends, and another, that holds too much, is divided. In pairs, so that the sizes of the levels stay.
#pragma once

#include <vector>

#include "limber/hierarchy/change_budget.h"
#include "limber/hierarchy/clustering.h"
#include "limber/hierarchy/level_graph.h"
#include "limber/hierarchy/swap_validity.h"
#include "limber/hierarchy/worth.h"

namespace limber {

struct RebirthOptions {
  // What a birth must gain for every unit that the death costs, >= 1: above 1, pairs do not go to and fro. 0: no
  // births.
  double hysteresis = 1.5;
  // Births and deaths are looked for again on a level while they change more than this share of its clusters, >= 0.
  double again = 0.02;
};

// Keeps its scratch memory between calls.
class Rebirth {
 public:
  // All of them must outlive this object.
  Rebirth(Clustering& clusters, SwapValidity& is_valid, const Worth& worth, ChangeBudget& budget)
      : clusters_(clusters),
        is_valid_(is_valid),
        worth_(worth),
        budget_(budget),
        is_locked_(clusters.hierarchy().node_count(), 0) {}

  // One round over the clusters of the nodes of `graph`, every cluster in one pair at most; a pair must gain more than
  // `least`. `coarser` says which clusters are neighbours; where they have changed since, other heirs are missed, and
  // what is a neighbour no more is no valid heir. Gives the clusters that have changed, two or three for each pair.
  const std::vector<Index>& pair_up(const LevelGraph& graph, const LevelGraph& coarser, double least,
                                    const RebirthOptions& options);

 private:
  struct Birth {
    double gain;
    Index cluster, founder;
  };
  struct Death {
    double cost;
    Index cluster, heir;
  };

  void find_births(const LevelGraph& graph, double least);
  void find_deaths(const LevelGraph& coarser, double most);
  bool end(const LevelGraph& graph, const Death& death);
  bool found(const LevelGraph& graph, const Birth& birth, Index cluster);
  void grow(const LevelGraph& graph, Index old, Index cluster);
  bool move(const LevelGraph& graph, Index node, Index to);
  void undo();

  Clustering& clusters_;
  SwapValidity& is_valid_;
  const Worth& worth_;
  ChangeBudget& budget_;
  std::vector<Birth> births_;
  std::vector<Death> deaths_;
  std::vector<Swap> moves_;  // that undo what the pair at work has moved, last first
  std::vector<Index> changed_;
  std::vector<char> is_locked_;  // [node_count]: has changed in this round
};

}  // namespace limber
