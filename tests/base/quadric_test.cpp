// SPDX-License-Identifier: Apache-2.0
#include "limber/base/quadric.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace limber {
namespace {

using test::Random;

Vec3d random_point(Random& random) { return static_cast<Vec3d>(random.point()); }

Vec3d random_direction(Random& random) {
  const Vec3d p = random_point(random) + Vec3d{1e-3, 2e-3, 3e-3};
  return p * (1 / length(p));
}

// Planes through a neighbourhood, of weights over six orders of magnitude, and a light point.
Quadric random_quadric(Random& random) {
  Quadric q;
  for (int i = 0; i < 5; ++i)
    q += Quadric::plane(random_direction(random), random_point(random), std::pow(10.0, random.unit() * 3));
  q.add_point(random_point(random), 1e-4);
  return q;
}

TEST(Quadric, HasTheWeightOfItsPlanesAndThriceThatOfItsPointsAsItsTrace) {
  Quadric q = Quadric::plane({0, 0.6, 0.8}, {1, 2, 3}, 5) + Quadric::plane({1, 0, 0}, {0, 0, 0}, 2);
  EXPECT_NEAR(q.trace(), 7, 1e-14);
  q.add_point({4, 5, 6}, 10);
  EXPECT_NEAR(q.trace(), 37, 1e-13);
}

TEST(Quadric, OfAPlaneIsTheWeightedSquaredDistanceToIt) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3d normal = random_direction(random), on_plane = random_point(random), x = random_point(random);
    const double distance = dot(normal, x - on_plane);
    EXPECT_NEAR(Quadric::plane(normal, on_plane, 2.5)(x), 2.5 * distance * distance, 1e-14);
    EXPECT_NEAR(Quadric::plane(normal, on_plane, 2.5)(on_plane), 0, 1e-14);
  }
}

TEST(Quadric, OfAPointIsTheWeightedSquaredDistanceToIt) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3d p = random_point(random), x = random_point(random);
    Quadric q;
    q.add_point(p, 0.75);
    EXPECT_NEAR(q(x), 0.75 * squared_length(x - p), 1e-14);
  }
}

TEST(Quadric, OfASumIsTheSumOfTheQuadrics) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Quadric a = random_quadric(random), b = random_quadric(random);
    const Vec3d x = random_point(random);
    EXPECT_NEAR((a + b)(x), a(x) + b(x), 1e-12 * (a(x) + b(x)));
    EXPECT_NEAR((a + b - b)(x), a(x), 1e-12 * (a(x) + b(x)));
    EXPECT_EQ(a + b, b + a);
  }
}

TEST(QuadricMinimum, OfOnePointIsThatPoint) {
  Quadric q;
  q.add_point({1, -2, 3}, 1e-9);
  const QuadricMinimum at = minimum(q);
  EXPECT_NEAR(length(at.point - Vec3d{1, -2, 3}), 0, 1e-12);
  EXPECT_NEAR(at.value, 0, 1e-22);
}

TEST(QuadricMinimum, OfThreePlanesIsTheirCorner) {
  Quadric q = Quadric::plane({1, 0, 0}, {0.25, 9, 9}, 1) + Quadric::plane({0, 1, 0}, {9, -0.5, 9}, 2) +
              Quadric::plane({0, 0, 1}, {9, 9, 0.75}, 3);
  EXPECT_NEAR(length(minimum(q).point - Vec3d{0.25, -0.5, 0.75}), 0, 1e-14);
}

TEST(QuadricMinimum, OfAPlaneAndALightPointIsTheFootOfThePoint) {
  Quadric q = Quadric::plane({0, 0, 1}, {0, 0, 0.5}, 1);
  q.add_point({0.3, -0.2, 0.5}, 1e-4);
  EXPECT_NEAR(length(minimum(q).point - Vec3d{0.3, -0.2, 0.5}), 0, 1e-12);
}

TEST(QuadricMinimum, IsBelowEveryPlaceAroundIt) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Quadric q = random_quadric(random);
    const QuadricMinimum at = minimum(q);
    ASSERT_GE(at.value, 0);
    ASSERT_NEAR(at.value, q(at.point), 1e-9 * (q.c + 1));
    for (const double step : {1e-2, 1e-1, 1.0, 10.0})
      for (int k = 0; k < 20; ++k)
        ASSERT_GE(q(at.point + random_direction(random) * step), at.value - 1e-9 * (q.c + 1)) << step;
  }
}

TEST(QuadricMinimum, LiesWhereASearchByHalvingStepsFindsIt) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    Quadric q = random_quadric(random);
    q.add_point(random_point(random), 10);  // so that the search is quick
    Vec3d x{};
    for (double step = 4; step > 1e-9;) {
      Vec3d best = x;
      for (const Vec3d& d : {Vec3d{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
        if (q(x + d * step) < q(best)) best = x + d * step;
      best == x ? void(step *= 0.5) : void(x = best);
    }
    EXPECT_NEAR(length(minimum(q).point - x), 0, 1e-5);
  }
}

TEST(Quadric, ScaledHasScaledValuesAndTheSameMinimum) {
  Random random(8);
  Quadric q;
  for (int k = 0; k < 4; ++k) q += Quadric::plane(random_direction(random), random_point(random), 1);
  q.add_point(random_point(random), 0.5);
  Quadric four = q;
  four *= 4;
  const Vec3d x = random_point(random);
  EXPECT_EQ(four(x), 4 * q(x));
  EXPECT_LT(length(minimum(four).point - minimum(q).point), 1e-12);
}

TEST(QuadricMinimum, NeverHasANegativeValue) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random_point(random);
    Quadric q;  // everything passes through one point: the value is nothing but rounding
    for (int k = 0; k < 4; ++k) q += Quadric::plane(random_direction(random), p, 1);
    q.add_point(p, 1e-4);
    ASSERT_GE(minimum(q).value, 0);
    ASSERT_LE(minimum(q).value, 1e-14);
  }
}

TEST(QuadricMinimum, HasTheSameValueWhenTwoAreFoundAtOnce) {
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const Quadric a = random_quadric(random), b = random_quadric(random);
    const Double2 values = minimum_values(a, b);
    ASSERT_NEAR(values[0], minimum(a).value, 1e-12 * a.c);
    ASSERT_NEAR(values[1], minimum(b).value, 1e-12 * b.c);
  }
  const Double2 none = minimum_values(Quadric{}, Quadric{});
  EXPECT_EQ(none[0], 0);
  EXPECT_EQ(none[1], 0);
}

TEST(QuadricMinimum, OfAQuadricWithoutAPointIsFiniteAllTheSame) {
  Random random(7);
  EXPECT_TRUE(is_finite(minimum(Quadric{}).point));
  for (int i = 0; i < 1000; ++i) {
    const Quadric q = Quadric::plane(random_direction(random), random_point(random), 1);
    const QuadricMinimum at = minimum(q);
    ASSERT_TRUE(is_finite(at.point) && std::isfinite(at.value)) << i;
  }
}

}  // namespace
}  // namespace limber
