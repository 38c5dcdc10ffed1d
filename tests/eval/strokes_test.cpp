// SPDX-License-Identifier: Apache-2.0
#include "eval/strokes.h"

#include <gtest/gtest.h>

namespace limber::eval {
namespace {

TEST(SilhouetteEdges, AreTheBordersAndTheFolds) {
  // Two triangles over the diagonal 0-2 of a square, both seen from the front: four borders.
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<ScreenPoint> points = {{0, 10, 1}, {10, 10, 1}, {10, 0, 1}, {0, 0, 1}};
  EXPECT_EQ(silhouette_edges(triangles, points), (std::vector<Segment>{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  // Folded over the diagonal, the second shows its back: the diagonal joins them.
  points[3] = {11, 9, 1};
  EXPECT_EQ(silhouette_edges(triangles, points), (std::vector<Segment>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}}));
}

TEST(InkShare, FallsFromTheMiddleOfTheLineToItsBorder) {
  EXPECT_EQ(ink_share(0.0, 2.0), 1.0f);
  EXPECT_FLOAT_EQ(ink_share(1.0, 2.0), 0.5f);
  EXPECT_EQ(ink_share(1.5, 2.0), 0.0f);
}

}  // namespace
}  // namespace limber::eval
