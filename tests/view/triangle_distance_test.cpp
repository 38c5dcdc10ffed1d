// SPDX-License-Identifier: Apache-2.0
#include "limber/view/triangle_distance.h"

#include <gtest/gtest.h>

#include "tests/view/patches.h"

namespace limber {
namespace {

Vec3f random_point(test::Random& random) {
  const float x = 4 * random.unit() - 2, y = 4 * random.unit() - 2, z = 4 * random.unit() - 2;
  return {x, y, z};
}

// To the closest of a lattice of points on the triangle, in doubles.
double sampled_distance(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c, int count) {
  const Vec3d at(p), from(a), ab(b - a), ac(c - a);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= count; ++i)
    for (int j = 0; i + j <= count; ++j)
      least = std::min(least, squared_length(at - from - ab * (double(i) / count) - ac * (double(j) / count)));
  return std::sqrt(least);
}

TEST(TriangleDistance, IsTheHeightAboveTheTriangleAndToItsSidesAndCornersBesideIt) {
  const Vec3f a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({1, 1, 3}, a, b, c), 9);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({1, 1, 0}, a, b, c), 0);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({2, -3, 4}, a, b, c), 25);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({4, 4, 0}, a, b, c), 8);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({-1, -2, 2}, a, b, c), 9);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({7, 0, 0}, a, b, c), 9);
}

TEST(TriangleDistance, IsThatToTheClosestPoint) {
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3f p = random_point(random), a = random_point(random), b = random_point(random), c = random_point(random);
    constexpr int kCount = 60;
    const double exact = std::sqrt(double{squared_distance_to_triangle(p, a, b, c)});
    const double sampled = sampled_distance(p, a, b, c, kCount);
    const double spacing = std::max({length(b - a), length(c - a), length(c - b)}) / kCount;
    EXPECT_LE(exact, sampled + 1e-4);
    EXPECT_GE(exact, sampled - spacing);
  }
}

TEST(TriangleDistance, DoesNotDependOnWhichCornerComesFirst) {
  test::Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3f p = random_point(random), a = random_point(random), b = random_point(random), c = random_point(random);
    const float square = squared_distance_to_triangle(p, a, b, c);
    EXPECT_NEAR(squared_distance_to_triangle(p, b, c, a), square, 1e-4f * (1 + square));
    EXPECT_NEAR(squared_distance_to_triangle(p, a, c, b), square, 1e-4f * (1 + square));
  }
}

TEST(TriangleDistance, IsNeverLessThanTheDistanceWhereATriangleIsALineOrAPoint) {
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{3, 0, 0};
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({2, 2, 0}, a, b, c), 4);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({5, 0, 0}, a, c, b), 4);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({1, 2, 2}, b, b, b), 8);
  EXPECT_FLOAT_EQ(squared_distance_to_triangle({2, 2, 0}, a, {1, 1e-9f, 0}, c), 4);
}

TEST(SegmentDistance, IsThatToTheEndsBeyondThem) {
  const Vec3f a{1, 1, 1}, b{3, 1, 1};
  EXPECT_FLOAT_EQ(squared_distance_to_segment({2, 1, 3}, a, b), 4);
  EXPECT_FLOAT_EQ(squared_distance_to_segment({0, 1, 1}, a, b), 1);
  EXPECT_FLOAT_EQ(squared_distance_to_segment({5, 1, 1}, a, b), 4);
  EXPECT_FLOAT_EQ(squared_distance_to_segment({1, 1, 4}, a, a), 9);
}

}  // namespace
}  // namespace limber
