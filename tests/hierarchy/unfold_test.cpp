// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/unfold.h"

#include <gtest/gtest.h>

#include "limber/base/triangles.h"
#include "limber/hierarchy/validate.h"
#include "tests/hierarchy/weighed.h"

namespace limber {
namespace {

using test::Random;
using test::Shape;

// A level whose clusters have been frayed by swaps that nobody asked for.
struct Frayed {
  Frayed(const Shape& given, Topology topology, Index at_level)
      : shape(given),
        clusters(test::weighed(shape, 4, topology)),
        graph(test::graph_of(shape.mesh, clusters.hierarchy(), at_level, topology == Topology::kFree)),
        is_valid(clusters.hierarchy(), clusters.children(), topology),
        worth(clusters, Benefit::kExact),
        budget(clusters.hierarchy()),
        unfolder(clusters, is_valid, worth, budget) {
    worth.set_weights(1.9, 0.2);
    Random random(5);
    for (Index round = 0; round < 2 * graph.size(); ++round) {
      const Index node = graph.first_node + random.below(graph.size());
      const auto around = graph.around(node);
      const Index to = clusters.parent(around[random.below(static_cast<Index>(around.size()))]);
      if (to == clusters.parent(node) || clusters.has_one_child(clusters.parent(node))) continue;
      if (is_valid(graph, node, to)) clusters.move(node, to);
    }
  }

  // Of the level above the graph.
  int turned_over() const {
    std::vector<Triangle> triangles;
    list_images(graph.triangles, clusters.hierarchy().parent, triangles);
    int count = 0;
    for (const auto& [a, b, c] : triangles) {
      Facing surface = clusters.facing(a);
      surface += clusters.facing(b);
      surface += clusters.facing(c);
      count += is_turned_over(clusters.minimum_at(a), clusters.minimum_at(b), clusters.minimum_at(c), surface);
    }
    return count;
  }

  Shape shape;
  Clustering clusters;
  LevelGraph graph;
  SwapValidity is_valid;
  Worth worth;
  ChangeBudget budget;
  Unfolder unfolder;
};

Shape waves() { return test::waved(test::sheet(24, 24)); }

TEST(Unfolder, TurnsMostTrianglesBackBySwapsThatKeepTheHierarchySound) {
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    for (const Index level : {0u, 1u}) {
      Frayed scene(waves(), topology, level);
      const int before = scene.turned_over();
      ASSERT_GT(before, 3) << level;
      scene.unfolder.unfold(scene.graph, 1e9);
      EXPECT_LE(scene.turned_over(), before / 3) << level << " of " << before;
      const auto violation = Validator(scene.shape.mesh, topology)(scene.clusters.hierarchy());
      EXPECT_FALSE(violation) << violation->line();
    }
  }
}

TEST(Unfolder, PaysNoMoreThanItMay) {
  Frayed dear(waves(), Topology::kPreserve, 0), cheap(waves(), Topology::kPreserve, 0);
  dear.unfolder.unfold(dear.graph, 1e9);
  cheap.unfolder.unfold(cheap.graph, 0);  // only what lowers the error, too
  EXPECT_GT(cheap.turned_over(), dear.turned_over());
  Frayed before(waves(), Topology::kPreserve, 0);
  EXPECT_LE(cheap.clusters.total_energy(1), before.clusters.total_energy(1));
}

TEST(Unfolder, LeavesALevelAloneThatLiesAsItShould) {
  Clustering flat = test::weighed(test::sheet(16, 16), 4);
  const Hierarchy before = flat.hierarchy();
  const LevelGraph graph = test::graph_of(test::sheet(16, 16).mesh, before, 0, false);
  SwapValidity is_valid(flat.hierarchy(), flat.children(), Topology::kPreserve);
  const Worth worth(flat, Benefit::kExact);
  ChangeBudget budget(flat.hierarchy());
  Unfolder(flat, is_valid, worth, budget).unfold(graph, 1e9);
  EXPECT_EQ(flat.hierarchy(), before);
}

TEST(Unfolder, LetsNoNodeGoBackToWhereItTurnsATriangleOver) {
  Frayed scene(waves(), Topology::kPreserve, 0);
  const Hierarchy before = scene.clusters.hierarchy();
  scene.unfolder.unfold(scene.graph, 1e9);
  const Hierarchy after = scene.clusters.hierarchy();
  int refused = 0;
  for (Index node = 0; node < scene.graph.size(); ++node) {
    const Index from = before.parent[node];
    if (after.parent[node] == from || !scene.is_valid(scene.graph, node, from)) continue;
    const int count = scene.turned_over();
    const bool has_moved = scene.unfolder.move(scene.graph, node, from);
    EXPECT_EQ(scene.clusters.parent(node), has_moved ? from : after.parent[node]);
    EXPECT_LE(scene.turned_over(), count);
    refused += !has_moved;
  }
  EXPECT_GT(refused, 0);
}

TEST(Unfolder, ChangesNoMoreThanTheBudgetAllows) {
  Frayed scene(waves(), Topology::kPreserve, 0);
  const Hierarchy before = scene.clusters.hierarchy();
  std::vector<LevelGraph> graphs;
  for (Index level = 0; level < before.level_count(); ++level)
    graphs.push_back(test::graph_of(scene.shape.mesh, before, level, false));
  scene.budget.limit(graphs, 0);
  scene.unfolder.unfold(scene.graph, 1e9);
  EXPECT_EQ(test::triangles_of(scene.shape.mesh, scene.clusters.hierarchy(), 1),
            test::triangles_of(scene.shape.mesh, before, 1));
}

}  // namespace
}  // namespace limber
