// SPDX-License-Identifier: Apache-2.0
// Which nodes to expand so that a budget buys the least error. Used by Cut.
// Part of the player: standard library only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/hierarchy/hierarchy.h"

namespace limber {

// Scratch that lives between frames; the choice itself depends on the arguments alone.
class Budget {
 public:
  // Allocates for hierarchies of these level sizes; choose() does not.
  void reserve(const Hierarchy& hierarchy);

  // What the nodes above the finest level are given with. Arrays are [node_count - vertex_count], coarse node n
  // at n - vertex_count.
  struct Costs {
    std::span<const float> errors;         // square root of the squared error that the node stands for, >= 0
    std::span<const std::uint32_t> price;  // what expanding the node uses up, once its parent is expanded; the sum over
                                           // all nodes is below 2^32
    std::uint32_t budget = 0;              // what may be used up in all
  };

  // Sets `expanded` ([node_count - vertex_count]) to a set of nodes, each with all its ancestors, whose prices sum
  // to at most the budget. Nodes are taken by the total squared error that they, with the best of their
  // descendants, take away per unit of price; a node that does not fit is passed over for later ones that do.
  // Where a node's `expanded` is set at the start its rank is multiplied by `hysteresis` (>= 1).
  void choose(const Hierarchy& hierarchy, const Costs& costs, float hysteresis, std::span<std::uint8_t> expanded);

  // The same for the least largest error: errors are those of single nodes, and nodes are taken from the largest error
  // down, each after its parent. None whose error is at most `enough`, >= 0, even where budget is left.
  void choose_worst_first(const Hierarchy& hierarchy, const Costs& costs, float enough, float hysteresis,
                          std::span<std::uint8_t> expanded);

 private:
  // A group's gain is the squared error it takes away, its price what it uses up.
  struct Group {
    double gain = 0;
    std::uint32_t price = 0;
  };

  void measure_gains(const Hierarchy& hierarchy, std::span<const float> errors);
  void rank_nodes(const Hierarchy& hierarchy, std::span<const std::uint32_t> price);
  Group best_group(Index node, float threshold, std::span<const std::uint32_t> price) const;
  void rank_below_parents(const Hierarchy& hierarchy, float hysteresis, std::span<const std::uint8_t> expanded);
  void take_by_rank(const Hierarchy& hierarchy, const Costs& costs, std::span<std::uint8_t> expanded);
  std::uint64_t take_whole_buckets(const Costs& costs, std::span<std::uint8_t> expanded);
  template <class Condition>
  void gather(Condition condition);
  std::uint64_t take_candidates(const Hierarchy& hierarchy, const Costs& costs, std::uint64_t left,
                                std::span<std::uint8_t> expanded);

  // All [node_count - vertex_count]; children are those above the finest level.
  std::vector<Index> first_child_, next_sibling_;
  std::vector<double> gain_;
  std::vector<float> rank_, best_child_;
  std::vector<std::uint64_t> candidates_;
  std::uint32_t last_bucket_ = 0;
};

}  // namespace limber
