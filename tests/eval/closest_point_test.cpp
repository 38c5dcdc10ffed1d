// SPDX-License-Identifier: Apache-2.0
#include "eval/closest_point.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

std::vector<Vec3d> random_points(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 * 1.5 - 0.25; };
  std::vector<Vec3d> points(count);
  for (Vec3d& p : points) p = {unit(), unit(), unit()};
  return points;
}

// By trying a fine lattice of the triangle's points: never below the true squared distance.
double squared_distance_by_lattice(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c, int steps) {
  double best = squared_length(p - a);
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      best = std::min(best, squared_length(p - (a + (b - a) * (double(i) / steps) + (c - a) * (double(j) / steps))));
    }
  }
  return best;
}

void expect_same(const ClosestPoint& one, const ClosestPoint& other) {
  EXPECT_EQ(one.point, other.point);
  EXPECT_EQ(one.squared_distance, other.squared_distance);
  EXPECT_EQ(one.triangle, other.triangle);
  EXPECT_EQ(one.barycentric, other.barycentric);
}

TEST(ClosestPointOnTriangle, LiesInsideOnAnEdgeOrAtACorner) {
  const Vec3d a{0, 0, 0}, b{4, 0, 0}, c{0, 4, 0};
  const ClosestPoint inside = closest_point_on_triangle({1, 2, 3}, a, b, c);
  EXPECT_EQ(inside.point, (Vec3d{1, 2, 0}));
  EXPECT_DOUBLE_EQ(inside.squared_distance, 9);
  EXPECT_EQ(inside.barycentric, (std::array<double, 3>{0.25, 0.25, 0.5}));

  const ClosestPoint on_edge = closest_point_on_triangle({3, 3, 1}, a, b, c);
  EXPECT_EQ(on_edge.point, (Vec3d{2, 2, 0}));
  EXPECT_DOUBLE_EQ(on_edge.squared_distance, 3);
  EXPECT_EQ(on_edge.barycentric, (std::array<double, 3>{0, 0.5, 0.5}));

  const ClosestPoint at_corner = closest_point_on_triangle({-1, -1, 0}, a, b, c);
  EXPECT_EQ(at_corner.point, a);
  EXPECT_EQ(at_corner.barycentric, (std::array<double, 3>{1, 0, 0}));
}

TEST(ClosestPointOnTriangle, IsNeverFartherThanAnyPointOfATriangleDegenerateOrNot) {
  const Shape soup = test::soup(90, 7);
  const Surface surface = soup;
  for (const Vec3d& p : random_points(60, 8)) {
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      const Vec3d a = corner(surface, t, 0), b = corner(surface, t, 1), c = corner(surface, t, 2);
      const ClosestPoint closest = closest_point_on_triangle(p, a, b, c);
      const double lattice = squared_distance_by_lattice(p, a, b, c, 24);
      EXPECT_LE(closest.squared_distance, lattice + 1e-12);
      EXPECT_GE(std::sqrt(closest.squared_distance), std::sqrt(lattice) - 0.02);
      EXPECT_NEAR(squared_length(p - closest.point), closest.squared_distance, 1e-12);
      EXPECT_LT(length(point_at(surface, t, closest.barycentric) - closest.point), 1e-9);
      for (const double weight : closest.barycentric) EXPECT_GE(weight, 0);
    }
  }
}

TEST(ClosestPointOnTriangle, HoldsForNeedlesOfAnyThinness) {
  for (const double thin : {1e-2, 1e-5, 1e-8, 1e-10, 1e-12, 1e-16, 0.0}) {
    const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0.5, thin, 0};
    const ClosestPoint above = closest_point_on_triangle({0.25, thin / 8, 0.5}, a, b, c);
    EXPECT_NEAR(above.squared_distance, 0.25, 1e-14) << thin;
    EXPECT_NEAR(above.point.x, 0.25, 1e-7) << thin;
    const ClosestPoint beyond = closest_point_on_triangle({2, 0, 0}, a, b, c);
    EXPECT_EQ(beyond.point, b) << thin;
  }
}

TEST(ClosestPointTree, AgreesWithTryingEveryTriangle) {
  const Shape soup = test::soup(600, 3);
  const Surface surface = soup;
  const ClosestPointTree tree(surface);
  for (const Vec3d& p : random_points(500, 4)) {
    ClosestPoint best;
    best.squared_distance = std::numeric_limits<double>::infinity();
    for (Index t = 0; t < soup.triangles.size(); ++t) {
      ClosestPoint here =
          closest_point_on_triangle(p, corner(surface, t, 0), corner(surface, t, 1), corner(surface, t, 2));
      here.triangle = t;
      if (here.squared_distance < best.squared_distance) best = here;
    }
    expect_same(tree.closest(p), best);
  }
}

TEST(ClosestPointTree, AnswersTheFirstOfEquallyCloseTriangles) {
  const Shape octahedron = test::octahedron();
  const ClosestPointTree tree(octahedron);
  EXPECT_EQ(tree.closest({0, 0, 0}).triangle, 0u);
  EXPECT_EQ(tree.closest({0, 0, -2}).triangle, 4u);
  EXPECT_EQ(tree.closest({0, 0, -2}, 7).triangle, 4u);

  Shape twice = octahedron;
  twice.triangles.insert(twice.triangles.end(), octahedron.triangles.begin(), octahedron.triangles.end());
  EXPECT_EQ(ClosestPointTree(twice).closest({0.5, 0.5, 0.5}, 8).triangle, 0u);
}

TEST(ClosestPointTree, GivesTheSameWithEveryHint) {
  const Shape sphere = test::sphere(20);
  const ClosestPointTree tree(sphere);
  for (const Vec3d& p : random_points(50, 5)) {
    const ClosestPoint expected = tree.closest(p);
    for (Index hint = 0; hint < tree.triangle_count(); hint += 37) expect_same(tree.closest(p, hint), expected);
  }
  // Points of the surface itself, where distances are rounding errors.
  const Surface surface = sphere;
  for (Index t = 0; t < tree.triangle_count(); t += 3) {
    const Vec3d p = point_at(surface, t, {0.5, 0.25, 0.25});
    for (Index hint = 0; hint < tree.triangle_count(); hint += 101) expect_same(tree.closest(p, hint), tree.closest(p));
  }
}

TEST(ClosestPointTree, GivesTheSameForEveryNumberOfThreads) {
  const ClosestPointTree tree(test::soup(300, 11));
  const std::vector<Vec3d> points = random_points(3000, 12);
  std::vector<ClosestPoint> one(points.size()), all(points.size());
  tree.closest(points, all);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  tree.closest(points, one);
  for (std::size_t i = 0; i < points.size(); ++i) expect_same(one[i], all[i]);
}

TEST(ClosestPointTree, LosesNothingFarFromTheOrigin) {
  const Shape near = test::square(4);
  const Shape far = test::shifted(near, {4096, -8192, 2048});
  const ClosestPointTree near_tree(near), far_tree(far);
  for (const Vec3d& p : random_points(200, 6)) {
    const double expected = std::sqrt(near_tree.closest(p).squared_distance);
    const ClosestPoint closest = far_tree.closest(p + Vec3d{4096, -8192, 2048});
    EXPECT_NEAR(std::sqrt(closest.squared_distance), expected, 1e-11);
  }
}

TEST(ClosestPointTree, HoldsWhereSinglePrecisionWouldOverflowOrVanish) {
  for (const float size : {1e-15f, 1e15f}) {
    const ClosestPointTree tree(test::scaled(test::octahedron(), size));
    const ClosestPoint closest = tree.closest({0, 0, 3.0 * static_cast<double>(size)});
    EXPECT_NEAR(std::sqrt(closest.squared_distance) / static_cast<double>(size), 2, 1e-6);
  }
}

TEST(ClosestPointTree, FollowsTheSurfaceWhenRebuilt) {
  ClosestPointTree tree(test::square(8));
  EXPECT_DOUBLE_EQ(tree.closest({0.5, 0.5, 2}).squared_distance, 4);
  tree.rebuild(test::square(2, 1));
  EXPECT_EQ(tree.triangle_count(), 8u);
  EXPECT_DOUBLE_EQ(tree.closest({0.5, 0.5, 2}).squared_distance, 1);
  ClosestPointTree other = std::move(tree);
  EXPECT_DOUBLE_EQ(other.closest({0.5, 0.5, 3}).squared_distance, 4);
}

TEST(ClosestPointTree, AnswersForASurfaceThatIsOnePoint) {
  const ClosestPointTree tree(Shape{{{0, 0, 0}}, {{1, 2, 3}}});
  const ClosestPoint closest = tree.closest({1, 2, 5});
  EXPECT_EQ(closest.point, (Vec3d{1, 2, 3}));
  EXPECT_DOUBLE_EQ(closest.squared_distance, 4);
}

}  // namespace
}  // namespace limber::eval
