// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/leeway.h"

#include <gtest/gtest.h>
#include <random>

namespace limber {
namespace {

constexpr LeewayOptions kOptions{.error_share = 0.02, .distance = 1e-3};

// A plane of area 1 with normal z, and a little of a point.
Quadric flat() {
  Quadric q = Quadric::plane({0, 0, 1}, {0, 0, 0}, 1.0);
  q.add_point({0, 0, 0}, 1e-5);
  return q;
}

Quadric random_quadric(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Quadric q;
  for (int i = 0; i < 4; ++i) {
    const Vec3d normal{number(random), number(random), number(random)};
    q += Quadric::plane(normal * (1 / length(normal)), {number(random), number(random), number(random)}, 0.25);
  }
  q.add_point({}, 1e-5);
  return q;
}

TEST(Leeway, LetsTheErrorGrowByItsShareAndTheDistanceAndNoMore) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int i = 0; i < 1000; ++i) {
    const Quadric q = random_quadric(random);
    const QuadricMinimum at = minimum(q);
    const double area = q.trace(), allowed = 0.02 * at.value + area * 1e-6;
    const Vec3d wanted{number(random), number(random), number(random)};
    const Vec3d d = displacement_towards(wanted, leeway(q, at.value, 1, kOptions));
    EXPECT_LE(q(at.point + d) - at.value, allowed * 1.001 + 1e-12);
    EXPECT_GE(dot(d, wanted), 0);
  }
}

TEST(Leeway, LetsANodeMoveAlongAPlaneButNotOffIt) {
  const Leeway free = leeway(flat(), 0, 1, kOptions);
  const Vec3d along = displacement_towards({0.1, -0.05, 0}, free);
  EXPECT_NEAR(along.x, 0.1, 1e-5);
  EXPECT_NEAR(along.y, -0.05, 1e-5);
  EXPECT_LE(length(displacement_towards({0, 0, 0.1}, free)), 1e-3);
}

TEST(Leeway, StaysWhereItIsWhenThatIsWanted) {
  EXPECT_EQ(displacement_towards({}, leeway(flat(), 1, 1, kOptions)), Vec3d());
}

TEST(Leeway, IsInTheUnitsOfThePositions) {
  // The quadric is that of a surface ten times as large: areas a hundred times, squared errors ten thousand times.
  std::mt19937 random(5);
  const Quadric q = random_quadric(random);
  Quadric large = q;
  for (double* a : {&large.xx, &large.xy, &large.xz, &large.yy, &large.yz, &large.zz}) *a *= 100;
  const Leeway a = leeway(q, minimum(q).value, 1, kOptions), b = leeway(large, 1e4 * minimum(q).value, 10, kOptions);
  const Vec3d d{0.003, 0.001, -0.002};
  EXPECT_NEAR(a(d), b(d), 1e-4 * a(d));
}

TEST(Leeway, IsFiniteWhereThereIsNoSurface) {
  const Vec3d d = displacement_towards({1, 1, 1}, leeway(Quadric{}, 0, 1, kOptions));
  EXPECT_TRUE(is_finite(d));
}

}  // namespace
}  // namespace limber
