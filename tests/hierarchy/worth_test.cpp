// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/worth.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/hierarchy/weighed.h"

namespace limber {
namespace {

constexpr double kGrowth = 1.7, kCoarserWeight = 0.3;

double weighted_error(const Clustering& c) {
  const Hierarchy& h = c.hierarchy();
  double sum = 0, weight = 1;
  for (Index level = 1; level < h.level_count(); ++level) {
    if (level > 1)
      weight *= kCoarserWeight * std::pow(static_cast<double>(h.level_size(level)) / h.level_size(level - 1), kGrowth);
    sum += weight * c.total_energy(level);
  }
  return sum;
}

// From the level of the node's parent on, as Worth weighs it.
double weight_of(const Hierarchy& h, Index level) {
  double weight = 1;
  for (Index k = 2; k <= level; ++k)
    weight *= kCoarserWeight * std::pow(static_cast<double>(h.level_size(k)) / h.level_size(k - 1), kGrowth);
  return weight;
}

struct Both {
  Both() {
    exact.set_weights(kGrowth, kCoarserWeight);
    fixed.set_weights(kGrowth, kCoarserWeight);
  }
  Clustering c = test::weighed(test::jittered(test::sphere(3), 0.1f, 1), 3);
  Worth exact{c, Benefit::kExact}, fixed{c, Benefit::kFixed};
};

TEST(Worth, OfASwapIsWhatTheWeightedErrorFallsBy) {
  Both b;
  test::Random random(2);
  int better = 0;
  for (int round = 0; round < 500; ++round) {
    const Hierarchy& h = b.c.hierarchy();
    const Index level = random.below(h.level_count() - 1);
    const Index node = h.level_begin[level] + random.below(h.level_size(level));
    const Index from = b.c.parent(node), to = h.level_begin[level + 1] + random.below(h.level_size(level + 1));
    if (from == to) continue;
    const double worth = b.exact.of_swap(node, to), estimate = b.fixed.of_swap(node, to);
    EXPECT_LE(estimate, worth + 1e-15) << "equation 1 promises too much";
    const double before = weighted_error(b.c);
    b.c.move(node, to);
    EXPECT_NEAR(before - weighted_error(b.c), worth * weight_of(h, level + 1), 1e-12);
    better += worth > 0;
    if (worth <= 0) b.c.move(node, from);
  }
  EXPECT_GT(better, 0);
}

TEST(Worth, OfSeveralSwapsIsThatOfEach) {
  Both b;
  test::Random random(7);
  const Hierarchy& h = b.c.hierarchy();
  for (int round = 0; round < 200; ++round) {
    const Index level = random.below(h.level_count() - 1);
    const Index node = h.level_begin[level] + random.below(h.level_size(level));
    std::vector<Index> to;
    for (Index count = 1 + random.below(5); to.size() < count;) {
      const Index cluster = h.level_begin[level + 1] + random.below(h.level_size(level + 1));
      if (cluster != b.c.parent(node)) to.push_back(cluster);
    }
    for (const Worth* worth : {&b.exact, &b.fixed}) {
      std::vector<double> worths(to.size());
      worth->of_swaps(node, to, worths);
      for (std::size_t i = 0; i < to.size(); ++i) EXPECT_EQ(worths[i], worth->of_swap(node, to[i])) << i;
    }
  }
}

TEST(Worth, OfADeathIsWhatTheWeightedErrorFallsByWhenAllChildrenHaveGone) {
  Both b;
  test::Random random(3);
  const Hierarchy& h = b.c.hierarchy();
  for (int round = 0; round < 200; ++round) {
    const Index level = 1 + random.below(h.level_count() - 2);
    const Index cluster = h.level_begin[level] + random.below(h.level_size(level));
    const Index heir = h.level_begin[level] + random.below(h.level_size(level));
    if (cluster == heir) continue;
    const double worth = b.exact.of_death(cluster, heir);
    const double before = weighted_error(b.c);
    std::vector<Index> moved;
    for (Index child; (child = b.c.children().first_child(cluster)) != kNone;) {
      moved.push_back(child);
      b.c.move(child, heir);
    }
    EXPECT_NEAR(before - weighted_error(b.c), worth * weight_of(h, level), 1e-12);
    for (const Index child : moved) b.c.move(child, cluster);
  }
}

TEST(Worth, EstimatesAreExactForDistancesToPoints) {
  Clustering c(Hierarchy{{0, 6, 8}, {6, 6, 6, 7, 7, 7, kNone, kNone}});
  test::Random random(4);
  for (Quadric& q : c.finest_quadrics())
    q.add_point({random.unit(), random.unit(), random.unit()}, 1.5 + random.unit());
  c.weigh();
  const Worth worth(c, Benefit::kExact);
  for (Index v = 0; v < 3; ++v) {
    EXPECT_NEAR(worth.about_release(v), worth.release(v), 1e-12);
    EXPECT_NEAR(worth.about_release(v) - worth.about_burden(c.quadric(v), 7), worth.of_swap(v, 7), 1e-12);
  }
}

TEST(Worth, EstimatesAreOfTheRightSizeOnASurface) {
  Both b;
  const Hierarchy& h = b.c.hierarchy();
  double exact = 0, estimated = 0;
  for (Index v = 0; v < h.vertex_count(); ++v)
    if (!b.c.has_one_child(b.c.parent(v))) exact += b.exact.release(v), estimated += b.exact.about_release(v);
  EXPECT_GT(estimated, 0.4 * exact);
  EXPECT_LT(estimated, 1.2 * exact);
}

}  // namespace
}  // namespace limber
