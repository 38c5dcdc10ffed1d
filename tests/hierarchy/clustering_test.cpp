// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/clustering.h"

#include <gtest/gtest.h>

#include "tests/hierarchy/weighed.h"

namespace limber {
namespace {

using test::Random;

TEST(Clustering, SumsTheQuadricsOfAllVerticesBelowANode) {
  const Clustering c = test::weighed(test::jittered(test::sphere(2), 0.1f, 1), 3);
  const Hierarchy& h = c.hierarchy();
  for (Index level = 1; level < h.level_count(); ++level) {
    const std::vector<Index> node_of = test::ancestors(h, level);
    for (Index node = h.level_begin[level]; node < h.level_begin[level + 1]; ++node) {
      Quadric sum;
      for (Index v = 0; v < h.vertex_count(); ++v)
        if (node_of[v] == node) sum += c.quadric(v);
      EXPECT_NEAR(c.quadric(node).c, sum.c, 1e-14);
      EXPECT_NEAR(c.quadric(node).xx, sum.xx, 1e-14);
      EXPECT_NEAR(c.energy(node), sum(c.minimum_at(node)), 1e-14);
      Facing facing;
      for (Index v = 0; v < h.vertex_count(); ++v)
        if (node_of[v] == node) facing += c.facing(v);
      EXPECT_GT(facing.area, 0);
      EXPECT_NEAR(c.facing(node).area, facing.area, 1e-14);
      EXPECT_NEAR(c.facing(node).vector.z, facing.vector.z, 1e-14);
    }
  }
}

TEST(Clustering, WeighsAfterRandomMovesAsItWouldFromScratch) {
  Clustering c = test::weighed(test::jittered(test::sphere(3), 0.1f, 2), 3);
  Random random(3);
  for (int round = 0; round < 2000; ++round) {
    const Index level = random.below(c.hierarchy().level_count() - 1);
    const Hierarchy& h = c.hierarchy();
    const Index node = h.level_begin[level] + random.below(h.level_size(level));
    const Index to = h.level_begin[level + 1] + random.below(h.level_size(level + 1));
    if (to == c.parent(node) || c.has_one_child(c.parent(node))) continue;
    c.move(node, to);
    ASSERT_EQ(c.parent(node), to);
  }
  const std::vector<Quadric> moved(c.quadrics().begin(), c.quadrics().end());
  const std::vector<Facing> faced(c.facings().begin(), c.facings().end());
  std::vector<double> energies;
  for (Index level = 1; level < c.hierarchy().level_count(); ++level) energies.push_back(c.total_energy(level));
  c.weigh();
  for (Index node = 0; node < c.hierarchy().node_count(); ++node) {
    EXPECT_NEAR(c.quadric(node).xx, moved[node].xx, 1e-13);
    EXPECT_NEAR(c.quadric(node).c, moved[node].c, 1e-13);
    EXPECT_NEAR(c.facing(node).area, faced[node].area, 1e-13);
    EXPECT_NEAR(c.facing(node).vector.x, faced[node].vector.x, 1e-13);
  }
  for (Index level = 1; level < c.hierarchy().level_count(); ++level)
    EXPECT_NEAR(c.total_energy(level), energies[level - 1], 1e-9 * energies[level - 1]);
}

TEST(Clustering, KnowsClustersOfOneAndEmptyOnes) {
  Clustering c(Hierarchy{{0, 3, 5}, {3, 3, 4, kNone, kNone}});
  EXPECT_FALSE(c.has_one_child(3));
  EXPECT_TRUE(c.has_one_child(4));
  c.finest_quadrics()[2].add_point({1, 2, 3}, 0.1);
  c.weigh();
  c.move(2, 3);
  EXPECT_FALSE(c.has_one_child(4));
  EXPECT_EQ(c.quadric(4), Quadric{}) << "nothing of it is left, not even by rounding";
  EXPECT_EQ(c.energy(4), 0);
}

}  // namespace
}  // namespace limber
