// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/feature_weight.h"

#include <cmath>
#include <gtest/gtest.h>

namespace limber::eval {
namespace {

constexpr double kSixtyDegrees = 0.5;  // its cosine

// The weight of the edge between two vertices.
double weight(const std::vector<Triangle>& triangles, const std::vector<Vec3f>& positions, Index u, Index v,
              bool literal) {
  Surface surface(Mesh{static_cast<Index>(positions.size()), triangles});
  for (Index e = 0; e < surface.edge_count(); ++e) {
    const auto& ends = surface.ends(e);
    if ((ends[0] == u && ends[1] == v) || (ends[0] == v && ends[1] == u))
      return feature_weight(surface, e, {positions, 1, 0}, kSixtyDegrees, literal);
  }
  ADD_FAILURE() << "no such edge";
  return 0;
}

// A closed double pyramid over the edge 0 1: triangles meet in it at the angle given, 2 and 3 lie on either side.
struct Wedge {
  explicit Wedge(double degrees) {
    const double half = degrees / 360 * 3.14159265358979323846;
    const auto x = static_cast<float>(std::cos(half)), y = static_cast<float>(std::sin(half));
    positions = {{0, 0, 0}, {0, 0, 1}, {x, y, 0.5f}, {x, -y, 0.5f}};
  }
  std::vector<Triangle> triangles{{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {1, 3, 2}};  // a tetrahedron
  std::vector<Vec3f> positions;
};

// A square in 4 triangles around its middle 0; 1 to 4 are its corners.
const std::vector<Triangle> kFan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
const std::vector<Vec3f> kFanPositions{{0, 0, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

TEST(FeatureWeight, IsNothingForAnInteriorEdge) {
  const Wedge blunt(75);
  EXPECT_EQ(weight(blunt.triangles, blunt.positions, 0, 1, false), 0);
  EXPECT_EQ(weight(blunt.triangles, blunt.positions, 0, 1, true), 0);
}

TEST(FeatureWeight, OfASharpEdgeFallsToNothingAtAKnifeEdgeAsPrintedAndRisesByDefault) {
  const Wedge at_threshold(59.9), sharp(30), knife(0.5);
  EXPECT_NEAR(weight(at_threshold.triangles, at_threshold.positions, 0, 1, true), std::sqrt(0.75), 1e-2);
  EXPECT_NEAR(weight(at_threshold.triangles, at_threshold.positions, 0, 1, false), std::sqrt(0.75), 1e-2);
  EXPECT_NEAR(weight(sharp.triangles, sharp.positions, 0, 1, true), 0.5, 1e-5);
  EXPECT_NEAR(weight(sharp.triangles, sharp.positions, 0, 1, false), 0.96593, 1e-5);
  EXPECT_LT(weight(knife.triangles, knife.positions, 0, 1, true), 0.01);
  EXPECT_GT(weight(knife.triangles, knife.positions, 0, 1, false), 0.999);
}

TEST(FeatureWeight, OfASharpEdgeDoesNotDependOnWhichWayTrianglesFace) {
  Wedge wedge(30);
  const double facing_out = weight(wedge.triangles, wedge.positions, 0, 1, false);
  std::swap(wedge.triangles[0][0], wedge.triangles[0][1]);
  EXPECT_EQ(weight(wedge.triangles, wedge.positions, 0, 1, false), facing_out);
}

TEST(FeatureWeight, OfABoundaryEdgeGrowsFromStraightToFolded) {
  EXPECT_NEAR(weight(kFan, kFanPositions, 1, 2, true), 0, 1e-12) << "a right angle";
  EXPECT_NEAR(weight(kFan, kFanPositions, 1, 2, false), 0.5, 1e-12);
  // 1 2 3 in a line, and the border comes back by 4.
  const std::vector<Triangle> strip{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}};
  const std::vector<Vec3f> straight{{-2, 1, 0}, {-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 5, 0}};
  const double angle_at_1 = -std::sqrt(0.5), at_2 = -1;
  EXPECT_NEAR(weight(strip, straight, 1, 2, true), std::max(angle_at_1, at_2), 1e-6);
  EXPECT_NEAR(weight(strip, straight, 1, 2, false), (1 + angle_at_1) / 2, 1e-6);
  std::vector<Vec3f> all_straight = straight;
  all_straight[0] = {-2, 0, 0};
  EXPECT_NEAR(weight(strip, all_straight, 1, 2, true), -1, 1e-12);
  EXPECT_NEAR(weight(strip, all_straight, 1, 2, false), 0, 1e-12);
}

TEST(FeatureWeight, OfABoundaryIncidentEdgeIsAQuarterOfItsBoundaryEdges) {
  for (const bool literal : {false, true}) EXPECT_EQ(weight(kFan, kFanPositions, 0, 1, literal), 0.5);
  // Between the two corners of a square in two triangles, a boundary at both ends.
  const std::vector<Triangle> square{{1, 2, 3}, {1, 3, 0}};
  const std::vector<Vec3f> corners{{0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  for (const bool literal : {false, true}) EXPECT_EQ(weight(square, corners, 1, 3, literal), 1);
}

TEST(FeatureWeight, OfAComplexEdgeGrowsWithItsTriangles) {
  std::vector<Triangle> fins;
  std::vector<Vec3f> positions{{0, 0, 0}, {0, 0, 1}};
  for (Index n = 1; n <= 5; ++n) {
    fins.push_back({0, 1, n + 1});
    positions.push_back({static_cast<float>(n) - 3, 1, 0.5f});
    if (n < 3) continue;
    const double incident = 2 * n / 4.0;  // each fin has two boundary edges at it
    EXPECT_EQ(weight(fins, positions, 0, 1, true), n - 3 + incident);
    EXPECT_EQ(weight(fins, positions, 0, 1, false), n - 2 + incident);
  }
}

}  // namespace
}  // namespace limber::eval
