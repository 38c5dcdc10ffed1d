// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/change_budget.h"

#include <gtest/gtest.h>

#include "limber/hierarchy/swap_validity.h"
#include "tests/hierarchy/weighed.h"

namespace limber {
namespace {

using test::Shape;

std::vector<LevelGraph> graphs_of(const Shape& shape, const Hierarchy& h) {
  std::vector<LevelGraph> graphs;
  for (Index level = 0; level < h.level_count(); ++level) graphs.push_back(test::graph_of(shape.mesh, h, level, false));
  return graphs;
}

// The first valid swap of every finest vertex that the budget allows; how many it does not.
std::size_t swap_all(Clustering& clusters, ChangeBudget& budget, const LevelGraph& graph) {
  SwapValidity is_valid(clusters.hierarchy(), clusters.children(), Topology::kPreserve);
  std::size_t refused = 0;
  for (Index node = 0; node < graph.size(); ++node) {
    for (const Index n : graph.around(node)) {
      const Index to = clusters.parent(n);
      if (to == clusters.parent(node) || clusters.has_one_child(clusters.parent(node))) continue;
      if (!is_valid(graph, node, to)) continue;
      if (budget.move(clusters, graph, node, to)) break;
      ++refused;
    }
  }
  return refused;
}

TEST(ChangeBudget, NeverMakesMoreNewTrianglesOnAnyLevelThanItMay) {
  for (const Shape& shape : {test::jittered(test::sphere(4), 0.02f, 4), test::waved(test::sheet(30, 25))}) {
    for (const double share : {0.0, 0.02, 0.1, 0.5}) {
      Clustering clusters = test::weighed(shape, 3);
      const Hierarchy before = clusters.hierarchy();
      ChangeBudget budget(clusters.hierarchy());
      const std::vector<LevelGraph> graphs = graphs_of(shape, before);
      budget.limit(graphs, share);
      EXPECT_GT(swap_all(clusters, budget, graphs[0]), 0u);
      std::size_t all = 0;
      for (Index level = 1; level < before.level_count(); ++level) {
        const std::set<Triangle> old = test::triangles_of(shape.mesh, before, level),
                                 now = test::triangles_of(shape.mesh, clusters.hierarchy(), level);
        const auto fresh = std::ranges::count_if(now, [&](const Triangle& t) { return !old.contains(t); });
        EXPECT_LE(static_cast<double>(fresh), share * static_cast<double>(old.size())) << "level " << level;
        all += static_cast<std::size_t>(fresh);
      }
      EXPECT_EQ(all > 0, share > 0);
    }
  }
}

TEST(ChangeBudget, RefusesNothingWithoutALimit) {
  const Shape shape = test::jittered(test::sphere(4), 0.02f, 4);
  Clustering clusters = test::weighed(shape, 3);
  ChangeBudget budget(clusters.hierarchy());
  EXPECT_FALSE(budget.is_limited());
  EXPECT_EQ(swap_all(clusters, budget, test::graph_of(shape.mesh, clusters.hierarchy(), 0, false)), 0u);
}

TEST(ChangeBudget, LeavesTheHierarchyAsItWasWhereItRefuses) {
  const Shape shape = test::waved(test::sheet(30, 25));
  Clustering clusters = test::weighed(shape, 3);
  ChangeBudget budget(clusters.hierarchy());
  const std::vector<LevelGraph> graphs = graphs_of(shape, clusters.hierarchy());
  budget.limit(graphs, 0);
  ASSERT_TRUE(budget.is_limited());
  SwapValidity is_valid(clusters.hierarchy(), clusters.children(), Topology::kPreserve);
  int refused = 0;
  for (Index node = 0; node < graphs[0].size(); ++node) {
    const Hierarchy before = clusters.hierarchy();
    const Index to = clusters.parent(graphs[0].around(node)[0]);
    if (to == clusters.parent(node) || clusters.has_one_child(clusters.parent(node))) continue;
    if (!is_valid(graphs[0], node, to) || budget.move(clusters, graphs[0], node, to)) continue;
    ++refused;
    ASSERT_TRUE(clusters.hierarchy() == before) << node;
  }
  EXPECT_GT(refused, 0);
}

TEST(ChangeBudget, GivesBackWhatWasSpentSinceItWasKept) {
  const Shape shape = test::jittered(test::sphere(4), 0.02f, 4);
  Clustering clusters = test::weighed(shape, 3);
  const Hierarchy before = clusters.hierarchy();
  ChangeBudget budget(clusters.hierarchy());
  const std::vector<LevelGraph> graphs = graphs_of(shape, before);
  const auto swap_from_before = [&] {
    clusters.replace(before);
    clusters.weigh();
    return swap_all(clusters, budget, graphs[0]);
  };
  budget.limit(graphs, 0.05);
  budget.keep();
  const std::size_t refused = swap_from_before();
  const Hierarchy after = clusters.hierarchy();
  EXPECT_FALSE(after == before);
  swap_from_before();
  EXPECT_FALSE(clusters.hierarchy() == after);  // nearly all is spent
  budget.undo();
  EXPECT_EQ(swap_from_before(), refused);
  EXPECT_TRUE(clusters.hierarchy() == after);
}

}  // namespace
}  // namespace limber
