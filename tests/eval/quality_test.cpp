// SPDX-License-Identifier: Apache-2.0
#include "eval/quality.h"

#include <gtest/gtest.h>

#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

TEST(Quality, FindsNoInvertedTriangleInAFaithfulApproximation) {
  const Shape sphere = test::sphere(20);
  const Quality quality = measure_quality(sphere, ClosestPointTree(sphere), test::sphere(6));
  EXPECT_EQ(quality.triangle_count, test::sphere(6).triangles.size());
  EXPECT_EQ(quality.inverted, 0u);
  EXPECT_EQ(quality.degenerate, 0u);
}

TEST(Quality, CountsTheTrianglesThatFaceTheWrongWay) {
  const Shape sphere = test::sphere(20);
  Shape approximation = test::sphere(6);
  for (const std::size_t t : {3u, 7u, 20u}) std::swap(approximation.triangles[t][1], approximation.triangles[t][2]);
  const Quality quality = measure_quality(sphere, ClosestPointTree(sphere), approximation);
  EXPECT_EQ(quality.inverted, 3u);
}

TEST(Quality, DoesNotMistakeTheOtherSideOfAThinSheetForAnInversion) {
  // A sheet of two sides 1/64 apart; the approximation bulges, so that its middle lies beyond the sheet's other side.
  Shape sheet = test::square(16, 1.0f / 64);
  const Shape below = test::square(16);
  const auto offset = static_cast<Index>(sheet.positions.size());
  sheet.positions.insert(sheet.positions.end(), below.positions.begin(), below.positions.end());
  for (const Triangle& t : below.triangles) sheet.triangles.push_back({t[0] + offset, t[2] + offset, t[1] + offset});
  // One corner dips below; most of the triangle stays nearer to its own side.
  const Shape approximation{{{0, 1, 2}}, {{0, 0, 1.0f / 64}, {1, 0, 1.0f / 64}, {0, 1, -1.0f / 64}}};
  EXPECT_EQ(measure_quality(sheet, ClosestPointTree(sheet), approximation).inverted, 0u);
}

TEST(Quality, MeasuresTheSmallestAngles) {
  const float height = std::sqrt(3.0f) / 2;
  const Shape two{{{0, 1, 2}, {0, 1, 3}}, {{0, 0, 0}, {1, 0, 0}, {0.5f, height, 0}, {0, 1, 0}}};
  const Quality quality = measure_quality(two, ClosestPointTree(two), two);
  EXPECT_NEAR(quality.least_angle, 45, 1e-5);
  EXPECT_NEAR(quality.angle_percentile_5, 45, 1e-5);
  EXPECT_NEAR(quality.mean_angle, 52.5, 1e-5);
}

TEST(Quality, CountsDegenerateTrianglesAsAnAngleOfNothing) {
  const Shape square = test::square(2);
  const Shape three{{{0, 1, 1}, {0, 1, 2}, {0, 0, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Quality quality = measure_quality(square, ClosestPointTree(square), three);
  EXPECT_EQ(quality.degenerate, 2u);
  EXPECT_EQ(quality.inverted, 0u);
  EXPECT_EQ(quality.least_angle, 0);
  EXPECT_NEAR(quality.mean_angle, 15, 1e-9);
}

TEST(Quality, IsAllZeroWithoutTriangles) {
  const Shape square = test::square(2);
  const Quality quality = measure_quality(square, ClosestPointTree(square), Shape{});
  EXPECT_EQ(quality.triangle_count, 0u);
  EXPECT_EQ(quality.mean_angle, 0);
}

}  // namespace
}  // namespace limber::eval
