// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/vertex_errors.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace limber {
namespace {

// A roof over vertex 0: its four faces fall away by 1 to the corners.
struct Roof {
  Mesh mesh{5, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}}};
  FaceTable faces{mesh};
  VertexErrors errors{mesh, {{0, 0, 1}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}, 1, {}};
};

TEST(VertexErrors, FindsTheNeighbourThatCostsLeast) {
  const Roof roof;
  double least = 1e9;
  for (Index u = 1; u < 5; ++u)
    least = std::min(least, roof.errors.quadrics()[0](roof.errors.positions()[u]) + roof.errors.own_errors()[u]);
  EXPECT_DOUBLE_EQ(roof.errors.least_removal(roof.faces, 0), least);
}

// Five: an odd number, as they are computed two at a time.
TEST(VertexErrors, CostsForAllNeighboursAreThoseForEach) {
  const Mesh mesh{6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}}};
  const FaceTable faces(mesh);
  const VertexErrors errors(mesh, {{0, 0, 1}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1.5, 0, 0.2}, {-1, -1, 0}}, 1, {});
  Star star;
  ASSERT_TRUE(faces.gather(0, star));
  std::vector<double> costs(star.count);
  errors.removal_costs(star, costs);
  for (std::uint32_t i = 0; i < 5; ++i) EXPECT_EQ(costs[i], errors.removal_cost(0, star.ring[i]));
}

TEST(VertexErrors, GrowWithTheSquareOfTheAreaThatAVertexStandsFor) {
  Roof roof;
  const double before = roof.errors.squared_weight(1);
  EXPECT_DOUBLE_EQ(before, std::pow(roof.errors.quadrics()[1].trace(), 2));
  roof.errors.share(0, 1, 3);
  EXPECT_GT(roof.errors.squared_weight(1), before);
}

TEST(VertexErrors, OfASwapIsTheDistanceBetweenTheDiagonals) {
  const Roof roof;
  // From the top to 2 along (1, 1, -1), from 1 to 3 along (-2, 2, 0).
  EXPECT_NEAR(roof.errors.swap_error(0, 2, 1, 3), 4 / std::sqrt(24.0), 1e-12);
  EXPECT_NEAR(roof.errors.swap_error(1, 3, 2, 4), 0, 1e-12);
}

TEST(VertexErrors, SharesOutAllThatAVertexStoodFor) {
  Roof roof;
  const double before =
      roof.errors.quadrics()[0].trace() + roof.errors.quadrics()[1].trace() + roof.errors.quadrics()[3].trace();
  roof.errors.share(0, 1, 3);
  EXPECT_NEAR(roof.errors.quadrics()[1].trace() + roof.errors.quadrics()[3].trace(), before, 1e-12);
  EXPECT_GT(roof.errors.own_errors()[1], 0.0);
}

TEST(VertexErrors, KnowsATriangleThatFacesAwayFromTheSurfaceAroundItsCorners) {
  const Roof roof;
  const auto at = [&](Index v) { return roof.errors.positions()[v]; };
  const Vec3d normal = cross(at(2) - at(1), at(3) - at(1));
  EXPECT_FALSE(roof.errors.is_inverted({1, 2, 3}, 0, normal));
  EXPECT_TRUE(roof.errors.is_inverted({1, 3, 2}, 0, -normal));
}

TEST(VertexErrors, HoldsALineBesideItsFacesToo) {
  Roof roof;
  const Vec3d beside{0.5, -0.5, 0.5};
  const Vec3d off = beside + Vec3d{0.3, 0.3, 0};  // in the face, away from the edge
  const double before = roof.errors.quadrics()[0](off);
  roof.errors.hold_line(roof.faces, roof.faces.tag_edge(0, 1));
  EXPECT_GT(roof.errors.quadrics()[0](off), before + 0.01);
}

}  // namespace
}  // namespace limber
