// SPDX-License-Identifier: Apache-2.0
#include "limber/view/budget.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "tests/view/patches.h"

namespace limber {
namespace {

// A tree above the finest level, with prices that need not be numbers of children.
struct Tree {
  Hierarchy hierarchy;
  std::vector<float> errors;
  std::vector<std::uint32_t> price;

  Index size() const { return hierarchy.node_count() - hierarchy.vertex_count(); }
  Index parent(Index n) const {
    const Index p = hierarchy.parent[hierarchy.vertex_count() + n];
    return p == kNone ? kNone : p - hierarchy.vertex_count();
  }
  double gain(Index n) const {
    double gain = double{errors[n]} * double{errors[n]};
    for (Index child = 0; child < n; ++child) {
      if (parent(child) == n) gain -= double{errors[child]} * double{errors[child]};
    }
    return gain;
  }
  std::uint32_t price_of(const std::vector<std::uint8_t>& expanded) const {
    std::uint32_t sum = 0;
    for (Index n = 0; n < size(); ++n) sum += expanded[n] ? price[n] : 0;
    return sum;
  }
  double gain_of(const std::vector<std::uint8_t>& expanded) const {
    double sum = 0;
    for (Index n = 0; n < size(); ++n) sum += expanded[n] ? gain(n) : 0;
    return sum;
  }
};

// One finest vertex below each node of level 1; level sizes from level 1 up; parents from level 1 up, numbered from
// the first node of level 1.
Tree make_tree(const std::vector<Index>& level_sizes, const std::vector<Index>& parents, std::vector<float> errors,
               std::vector<std::uint32_t> price) {
  Tree tree;
  const Index base = level_sizes[0];
  tree.hierarchy.level_begin = {0, base};
  for (const Index size : level_sizes) {
    tree.hierarchy.level_begin.push_back(tree.hierarchy.level_begin.back() + size);
  }
  for (Index v = 0; v < base; ++v) tree.hierarchy.parent.push_back(base + v);
  for (const Index p : parents) tree.hierarchy.parent.push_back(base + p);
  tree.hierarchy.parent.resize(tree.hierarchy.node_count(), kNone);
  tree.errors = std::move(errors);
  tree.price = std::move(price);
  return tree;
}

std::vector<std::uint8_t> choose(const Tree& tree, std::uint32_t budget, float hysteresis = 1,
                                 std::vector<std::uint8_t> expanded = {}) {
  Budget chooser;
  chooser.reserve(tree.hierarchy);
  expanded.resize(tree.size());
  chooser.choose(tree.hierarchy, {tree.errors, tree.price, budget}, hysteresis, expanded);
  return expanded;
}

using Bits = std::vector<std::uint8_t>;

TEST(Budget, ExpandsFirstWhatTakesAwayMostErrorPerUnit) {
  //                             o3
  //                         o0  o1  o2
  const Tree tree = make_tree({3, 1}, {3, 3, 3}, {3, 2, 4, 10}, {2, 1, 2, 2});
  EXPECT_EQ(choose(tree, 1), Bits({0, 0, 0, 0})) << "the top does not fit, and nothing goes without it";
  EXPECT_EQ(choose(tree, 2), Bits({0, 0, 0, 1}));
  EXPECT_EQ(choose(tree, 4), Bits({0, 0, 1, 1}));
  EXPECT_EQ(choose(tree, 6), Bits({1, 0, 1, 1}));
  EXPECT_EQ(choose(tree, 7), Bits({1, 1, 1, 1}));
}

TEST(Budget, PassesOverWhatDoesNotFitForWhatDoes) {
  const Tree tree = make_tree({3, 1}, {3, 3, 3}, {3, 2, 4, 10}, {2, 1, 2, 2});
  EXPECT_EQ(choose(tree, 3), Bits({0, 1, 0, 1}));
  EXPECT_EQ(choose(tree, 5), Bits({0, 1, 1, 1}));
}

TEST(Budget, SeesTheChildThatGainsMuchBelowAParentThatGainsLittle) {
  //                     o4      o5          o4 gains nothing by itself, o0 below it gains 99
  //                   o0  o1  o2  o3        o5 gains 8, then 1 and 1
  const Tree tree = make_tree({4, 2}, {4, 4, 5, 5}, {9.9f, 1, 1, 1, 9.95f, 3.1622f}, {1, 1, 1, 1, 1, 1});
  EXPECT_EQ(choose(tree, 2), Bits({1, 0, 0, 0, 1, 0}));
}

TEST(Budget, ExpandsNodesWithoutAPriceWithTheirParents) {
  const Tree tree = make_tree({2, 2}, {2, 3}, {1, 1, 2, 1.5f}, {0, 0, 1, 1});
  EXPECT_EQ(choose(tree, 0), Bits({0, 0, 0, 0}));
  EXPECT_EQ(choose(tree, 1), Bits({1, 0, 1, 0}));
  EXPECT_EQ(choose(tree, 2), Bits({1, 1, 1, 1}));
}

TEST(Budget, KeepsWhatWasExpandedUntilAnotherGainsSoMuchMore) {
  const Tree even = make_tree({2}, {}, {10, 10.5f}, {1, 1});  // gains 100 and 110
  EXPECT_EQ(choose(even, 1), Bits({0, 1}));
  EXPECT_EQ(choose(even, 1, 1.25f, {1, 0}), Bits({1, 0}));
  EXPECT_EQ(choose(even, 1, 1.05f, {1, 0}), Bits({0, 1}));
  const Tree uneven = make_tree({2}, {}, {10, 11.5f}, {1, 1});  // 132
  EXPECT_EQ(choose(uneven, 1, 1.25f, {1, 0}), Bits({0, 1}));
}

TEST(Budget, ChoosesTheSameInAnyUnitOfLength) {
  Tree tree = make_tree({3, 1}, {3, 3, 3}, {3, 2, 4, 10}, {2, 1, 2, 2});
  for (const float unit : {1e-30f, 1e-12f, 1e12f, 1e30f}) {
    tree.errors = {3 * unit, 2 * unit, 4 * unit, 10 * unit};
    EXPECT_EQ(choose(tree, 4), Bits({0, 0, 1, 1}));
    EXPECT_EQ(choose(tree, 6), Bits({1, 0, 1, 1}));
  }
}

TEST(Budget, TakesErrorsThatAreNoNumbersWithoutHarm) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const Tree tree = make_tree({3, 1}, {3, 3, 3}, {nan, infinity, -1, infinity}, {2, 1, 2, 2});
  for (std::uint32_t budget = 0; budget < 9; ++budget) {
    EXPECT_LE(tree.price_of(choose(tree, budget)), budget);
  }
}

TEST(Budget, TakesTheWorstFirstAndNothingThatIsGoodEnough) {
  //                             o3
  //                         o0  o1  o2
  const Tree tree = make_tree({3, 1}, {3, 3, 3}, {3, 2, 20, 10}, {1, 1, 1, 1});
  const auto worst_first = [&](std::uint32_t budget, float enough) {
    Budget chooser;
    chooser.reserve(tree.hierarchy);
    Bits expanded(4);
    chooser.choose_worst_first(tree.hierarchy, {tree.errors, tree.price, budget}, enough, 1, expanded);
    return expanded;
  };
  EXPECT_EQ(worst_first(0, 0), Bits({0, 0, 0, 0}));
  EXPECT_EQ(worst_first(1, 0), Bits({0, 0, 0, 1})) << "not the worse one below it";
  EXPECT_EQ(worst_first(3, 0), Bits({1, 0, 1, 1}));
  EXPECT_EQ(worst_first(9, 0), Bits({1, 1, 1, 1}));
  EXPECT_EQ(worst_first(9, 2.5f), Bits({1, 0, 1, 1}));
  EXPECT_EQ(worst_first(9, 15), Bits({0, 0, 0, 0})) << "nothing without its parent";
}

// Every set of nodes that holds the parents of its members.
void for_each_cut(const Tree& tree, Bits& expanded, Index next, const std::function<void(const Bits&)>& visit) {
  if (next == kNone) return visit(expanded);
  const Index rest = next == 0 ? kNone : next - 1;
  for_each_cut(tree, expanded, rest, visit);
  if (tree.parent(next) != kNone && !expanded[tree.parent(next)]) return;
  expanded[next] = 1;
  for_each_cut(tree, expanded, rest, visit);
  expanded[next] = 0;
}

TEST(Budget, IsAsGoodAsTheBestOfAllCutsOnTheConvexHull) {
  test::Random random(7);
  for (int round = 0; round < 200; ++round) {
    const std::vector<Index> sizes = {6, 4, 2};
    std::vector<Index> parents;
    for (Index n = 0; n < 6; ++n) parents.push_back(6 + (n < 4 ? n : random.below(4)));
    for (Index n = 0; n < 4; ++n) parents.push_back(10 + (n < 2 ? n : random.below(2)));
    std::vector<float> errors;
    std::vector<std::uint32_t> price;
    for (Index n = 0; n < 12; ++n) errors.push_back(random.unit() * (n < 6 ? 1.0f : n < 10 ? 1.6f : 2.5f));
    for (Index n = 0; n < 12; ++n) price.push_back(1 + random.below(4));
    const Tree tree = make_tree(sizes, parents, errors, price);

    std::vector<double> best(64, -1e30);  // gain by price
    Bits bits(12);
    for_each_cut(tree, bits, 11, [&](const Bits& expanded) {
      double& gain = best[tree.price_of(expanded)];
      gain = std::max(gain, tree.gain_of(expanded));
    });
    std::vector<std::uint32_t> hull = {0};
    while (true) {
      std::uint32_t next = 0;
      double slope = 0;
      for (std::uint32_t p = hull.back() + 1; p < best.size(); ++p) {
        const double s = (best[p] - best[hull.back()]) / (p - hull.back());
        if (s > slope) slope = s, next = p;
      }
      if (next == 0) break;
      hull.push_back(next);
    }
    for (std::uint32_t budget = 0; budget < best.size(); ++budget) {
      const Bits chosen = choose(tree, budget);
      EXPECT_LE(tree.price_of(chosen), budget);
      for (Index n = 0; n < 12; ++n) EXPECT_TRUE(!chosen[n] || tree.parent(n) == kNone || chosen[tree.parent(n)]);
      if (std::find(hull.begin(), hull.end(), budget) == hull.end()) continue;
      EXPECT_EQ(tree.price_of(chosen), budget);
      EXPECT_NEAR(tree.gain_of(chosen), best[budget], 1e-5);
    }
  }
}

}  // namespace
}  // namespace limber
