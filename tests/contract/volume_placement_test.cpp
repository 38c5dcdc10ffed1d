// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/volume_placement.h"

#include <array>
#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace limber {
namespace {

// Two vertices joined by an edge, and six around them:
//
//       2 --- 3         (0, 1, 3) and (1, 0, 6) are the triangles on the edge.
//      / \   / \ .
//     7 - 0 - 1 - 4
//      \ /   \ /
//       6 --- 5
constexpr std::array<Triangle, 8> kTriangles{
    {{0, 1, 3}, {1, 0, 6}, {0, 3, 2}, {0, 2, 7}, {0, 7, 6}, {1, 6, 5}, {1, 5, 4}, {1, 4, 3}}};

using Points = std::array<Vec3d, 8>;

Points at_random(std::uint64_t seed) {
  Points points{{{0, 0, 0}, {2, 0, 0}, {-1, 2, 0}, {1, 2, 0}, {4, 0, 0}, {3, -2, 0}, {1, -2, 0}, {-2, 0, 0}}};
  test::Random random(seed);
  for (Vec3d& p : points) p += static_cast<Vec3d>(random.point()) * 0.5;
  return points;
}

struct Stars {
  SymmetricMatrix first, second, shared;
};

Stars stars_of(const Points& p) {
  Stars stars;
  for (std::size_t t = 0; t < kTriangles.size(); ++t) {
    const auto& [a, b, c] = kTriangles[t];
    const Facet facet = Facet::of(p[a], p[b], p[c]);
    if (a == 0 || b == 0) add_facet(stars.first, facet);
    if (a == 1 || b == 1) add_facet(stars.second, facet);
    if (t < 2) add_facet(stars.shared, facet);
  }
  return stars;
}

// From scratch: the squared distances of x to the planes of all triangles, by twice their areas.
double cost_at(const Points& p, const Vec3d& x) {
  double sum = 0;
  for (std::size_t t = 0; t < kTriangles.size(); ++t) {
    const auto& [a, b, c] = kTriangles[t];
    const Vec3d n = cross(p[b] - p[a], p[c] - p[a]);
    sum += dot(n, x - p[a]) * dot(n, x - p[a]) / length(n);
  }
  return sum;
}

TEST(VolumePlacement, CostsWhatTheTrianglesAroundTheEdgeSay) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Points p = at_random(seed);
    const Stars stars = stars_of(p);
    const VolumePlacement placed = place(stars.first, stars.second, stars.shared, p[1] - p[0]);
    const Vec3d x = (p[0] + p[1]) * 0.5 + placed.point;
    EXPECT_NEAR(placed.cost, cost_at(p, x), 1e-9);
    test::Random random(seed);
    for (int i = 0; i < 20; ++i)
      EXPECT_GE(cost_at(p, x + static_cast<Vec3d>(random.point()) * 0.1), placed.cost - 1e-12);
  }
}

TEST(VolumePlacement, IsTheSameFromEitherEnd) {
  const Points p = at_random(1);
  const Stars stars = stars_of(p);
  const VolumePlacement there = place(stars.first, stars.second, stars.shared, p[1] - p[0]);
  const VolumePlacement back = place(stars.second, stars.first, stars.shared, p[0] - p[1]);
  EXPECT_NEAR(there.cost, back.cost, 1e-12);
  EXPECT_NEAR(length(there.point - back.point), 0, 1e-12);
}

TEST(VolumePlacement, IsInTheMiddleOfTheEdgeWhereAllIsFlat) {
  Points p = at_random(2);
  for (Vec3d& q : p) q.z = 0;
  Stars stars = stars_of(p);
  add_center(stars.first);
  add_center(stars.second);
  const VolumePlacement placed = place(stars.first, stars.second, stars.shared, p[1] - p[0]);
  EXPECT_LT(length(placed.point), 0.5 * length(p[1] - p[0]));
  EXPECT_LT(placed.cost, 1e-4);
}

TEST(VolumePlacement, OfNothingIsTheMiddleForNothing) {
  const VolumePlacement placed = place({}, {}, {}, {1, 2, 3});
  EXPECT_EQ(placed.point, (Vec3d{}));
  EXPECT_EQ(placed.cost, 0);
}

TEST(VolumePlacement, RimsHoldAcrossAndNotAlong) {
  SymmetricMatrix star;
  add_rim(star, {0, 0, 3}, 0.5);
  EXPECT_NEAR(dot(Vec3d{2, 0, 0}, star * Vec3d{2, 0, 0}), 0.5 * 36, 1e-12);
  EXPECT_NEAR(dot(Vec3d{0, 0, 7}, star * Vec3d{0, 0, 7}), 0, 1e-12);
}

TEST(VolumePlacement, RimsBeginWhereTheSurfaceTurnsBySixtyDegrees) {
  const Facet up{{0, 0, 1}, 1};
  EXPECT_EQ(rim_weight(up, up), 0);
  EXPECT_EQ(rim_weight(up, {{0.8, 0, 0.6}, 1}), 0);
  EXPECT_GT(rim_weight(up, {{0.9165, 0, 0.4}, 1}), 0);
  EXPECT_EQ(rim_weight(up, {{0, 0, -1}, 1}), 1);
}

TEST(Facet, WithoutAreaHasNoNormal) {
  const Facet facet = Facet::of({1, 1, 1}, {2, 2, 2}, {3, 3, 3});
  EXPECT_EQ(facet.area, 0);
  EXPECT_EQ(facet.normal, (Vec3d{}));
}

}  // namespace
}  // namespace limber
