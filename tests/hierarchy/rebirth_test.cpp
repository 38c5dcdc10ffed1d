// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/rebirth.h"

#include <gtest/gtest.h>
#include <memory>

#include "limber/hierarchy/validate.h"
#include "tests/hierarchy/weighed.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Shape;

// Everything that a round of births and deaths needs, on one level.
struct Scene {
  Scene(const Shape& shape, double branching, Topology topology, Index at_level)
      : clusters(test::weighed(shape, branching, topology)),
        level(at_level),
        graph(test::graph_of(shape.mesh, clusters.hierarchy(), level, topology == Topology::kFree)),
        coarser(test::graph_of(shape.mesh, clusters.hierarchy(), level + 1, topology == Topology::kFree)),
        is_valid(clusters.hierarchy(), clusters.children(), topology),
        worth(clusters, Benefit::kExact),
        budget(clusters.hierarchy()),
        rebirth(clusters, is_valid, worth, budget) {
    worth.set_weights(1.9, 0.2);
  }
  const std::vector<Index>& pair_up(double least, const RebirthOptions& options) {
    return rebirth.pair_up(graph, coarser, least, options);
  }
  double error() const { return clusters.total_energy(level + 1); }

  Clustering clusters;
  Index level;
  LevelGraph graph, coarser;
  SwapValidity is_valid;
  Worth worth;
  ChangeBudget budget;
  Rebirth rebirth;
};

// A flat sheet with a sharp bump in a corner, of which no contraction knew.
Shape bumped() {
  return moved(test::waved(test::sheet(14, 14)), [](Vec3f p) {
    const float dx = p.x - 3, dy = p.y - 3;
    return Vec3f{p.x, p.y, 3.0f / (1 + dx * dx + dy * dy)};
  });
}

// The hierarchy of the flat sheet, weighed on the bumped one.
std::unique_ptr<Scene> late(Topology topology, Index level) {
  auto late = std::make_unique<Scene>(test::waved(test::sheet(14, 14)), 4, topology, level);
  Scene& scene = *late;
  const Shape now = bumped();
  const Normalization to = normalization(now.positions);
  for (Index v = 0; v < now.mesh.vertex_count; ++v) scene.clusters.finest_positions()[v] = to.to_unit(now.positions[v]);
  VertexQuadrics(now.mesh, {}).compute(scene.clusters.finest_positions(), scene.clusters.finest_quadrics());
  scene.clusters.weigh();
  return late;
}

TEST(Rebirth, BringsClustersToWhereTheErrorIsAndKeepsTheirNumber) {
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    for (const Index level : {0u, 1u}) {
      const auto made = late(topology, level);
      Scene& scene = *made;
      const Shape shape = bumped();
      Validator validator(shape.mesh, topology);
      const double first = scene.error();
      std::size_t pairs = 0;
      for (int round = 0; round < 10; ++round) {
        const double before = scene.error();
        const std::size_t changed = scene.pair_up(0, {}).size();
        if (changed == 0) break;
        pairs += changed / 3;
        EXPECT_LT(scene.error(), before);
        const auto violation = validator(scene.clusters.hierarchy());  // clusters are not empty, and much else
        ASSERT_FALSE(violation) << violation->line();
      }
      EXPECT_GT(pairs, 0u) << level;
      EXPECT_LT(scene.error(), 0.9 * first) << level;
    }
  }
}

TEST(Rebirth, DoesNothingWithoutHysteresisOrWhereNothingGainsEnough) {
  const auto made = late(Topology::kPreserve, 0);
  Scene& scene = *made;
  const Hierarchy before = scene.clusters.hierarchy();
  EXPECT_TRUE(scene.pair_up(0, {.hysteresis = 0}).empty());
  EXPECT_TRUE(scene.pair_up(scene.error(), {}).empty());
  EXPECT_EQ(scene.clusters.hierarchy(), before);
}

TEST(Rebirth, MakesFewerPairsWithMoreHysteresis) {
  const auto little = late(Topology::kPreserve, 0), much = late(Topology::kPreserve, 0);
  const std::size_t many = little->pair_up(0, {.hysteresis = 1}).size();
  EXPECT_LT(much->pair_up(0, {.hysteresis = 20}).size(), many);
}

TEST(Rebirth, NamesEveryClusterThatHasChangedOnce) {
  const auto made = late(Topology::kPreserve, 0);
  Scene& scene = *made;
  const Hierarchy before = scene.clusters.hierarchy();
  std::vector<Index> changed = scene.pair_up(0, {});
  std::sort(changed.begin(), changed.end());
  EXPECT_TRUE(std::adjacent_find(changed.begin(), changed.end()) == changed.end());
  for (Index v = 0; v < before.vertex_count(); ++v) {
    const Index from = before.parent[v], to = scene.clusters.parent(v);
    if (from == to) continue;
    EXPECT_TRUE(std::binary_search(changed.begin(), changed.end(), from));
    EXPECT_TRUE(std::binary_search(changed.begin(), changed.end(), to));
  }
}

TEST(Rebirth, LeavesEverythingAsItWasWhereADeathFindsNoBirth) {
  // A tetrahedron whose edges have been divided, in clusters of its corners: none of them may end.
  const Shape shape = test::jittered(test::subdivided(test::tetrahedron()), 0.05f, 1);
  const Index count = shape.mesh.vertex_count;
  ASSERT_EQ(count, 10u);
  const LevelGraph finest = test::graph_of(shape.mesh, {{0, count}, std::vector<Index>(count, kNone)}, 0, false);
  Hierarchy corners{{0, count, count + 4}, std::vector<Index>(count + 4, kNone)};
  for (Index v = 0; v < count; ++v) corners.parent[v] = count + (v < 4 ? v : std::ranges::min(finest.around(v)));
  ASSERT_FALSE(Validator(shape.mesh, Topology::kPreserve)(corners));
  Clustering clusters(corners);
  for (Index v = 0; v < shape.mesh.vertex_count; ++v)
    clusters.finest_positions()[v] = normalization(shape.positions).to_unit(shape.positions[v]);
  VertexQuadrics(shape.mesh, {}).compute(clusters.finest_positions(), clusters.finest_quadrics());
  clusters.weigh();
  const LevelGraph graph = test::graph_of(shape.mesh, clusters.hierarchy(), 0, false),
                   coarser = test::graph_of(shape.mesh, clusters.hierarchy(), 1, false);
  SwapValidity is_valid(clusters.hierarchy(), clusters.children(), Topology::kPreserve);
  Worth worth(clusters, Benefit::kExact);
  worth.set_weights(1.9, 0.2);
  ChangeBudget budget(clusters.hierarchy());
  Rebirth rebirth(clusters, is_valid, worth, budget);
  const Hierarchy before = clusters.hierarchy();
  EXPECT_TRUE(rebirth.pair_up(graph, coarser, 0, {.hysteresis = 1e-9}).empty());
  EXPECT_EQ(clusters.hierarchy(), before);
}

TEST(Rebirth, KeepsEveryInvariantOnRandomShapes) {
  const Shape shapes[] = {test::torus(9, 24), test::waved(test::sheet_with_hole(18, 18)), test::sphere(3),
                          test::together(test::sphere(2), test::waved(test::sheet(9, 9)), 4)};
  std::size_t changed = 0;
  for (const Shape& shape : shapes) {
    for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
      Validator validator(shape.mesh, topology);
      for (const Index level : {0u, 1u, 2u}) {
        const Shape rough = test::jittered(shape, 0.1f, level);
        if (level + 2 > test::built(rough, 2.5, topology).level_count()) continue;  // the top has no clusters above
        Scene scene(rough, 2.5, topology, level);
        for (int round = 0; round < 20; ++round) {
          // Almost no hysteresis: what would never pay is made, too.
          changed += scene.pair_up(-1, {.hysteresis = 1e-6}).size();
          const auto violation = validator(scene.clusters.hierarchy());
          ASSERT_FALSE(violation) << violation->line();
        }
      }
    }
  }
  EXPECT_GT(changed, 1000u);
}

}  // namespace
}  // namespace limber
