// SPDX-License-Identifier: Apache-2.0
#include "eval/peers/oriented_manifold.h"

#include <gtest/gtest.h>

#include "limber/clip/clip.h"
#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

Mesh mesh_of(const test::Shape& shape) { return {static_cast<Index>(shape.positions.size()), shape.triangles}; }

std::string fault(const Mesh& mesh) {
  const Result<void> checked = check_oriented_manifold(mesh);
  return checked ? "" : checked.error().line();
}

TEST(OrientedManifold, SurfacesWithAndWithoutABorderAre) {
  EXPECT_EQ(fault(mesh_of(test::octahedron())), "");
  EXPECT_EQ(fault(mesh_of(test::square(4))), "");
  EXPECT_EQ(fault({3, {{0, 1, 2}}}), "");
  EXPECT_EQ(fault({0, {}}), "");
  EXPECT_EQ(fault((*open_clip("sample:gallop?vertices=400&frames=1", {}))->mesh()), "");
}

TEST(OrientedManifold, IsolatedVerticesDoNotMatter) { EXPECT_EQ(fault({9, {{3, 4, 5}, {3, 5, 7}}}), ""); }

TEST(OrientedManifold, AnEdgeOfThreeTrianglesIsNot) {
  EXPECT_EQ(fault({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}), "edge between vertices 0 and 1: lies on 3 triangles");
}

TEST(OrientedManifold, NeighboursThatFaceOppositeWaysAreNot) {
  EXPECT_EQ(fault({4, {{0, 1, 2}, {0, 1, 3}}}), "edge between vertices 0 and 1: its two triangles face opposite ways");
  EXPECT_EQ(fault({3, {{0, 1, 2}, {0, 1, 2}}}), "edge between vertices 0 and 1: its two triangles face opposite ways");
}

TEST(OrientedManifold, AVertexBetweenTwoFansIsNot) {
  EXPECT_EQ(fault({5, {{0, 1, 2}, {0, 3, 4}}}), "vertex 0: joins triangles that share no edge");
  Mesh two = mesh_of(test::octahedron());  // two closed fans
  for (Triangle t : test::octahedron().triangles) {
    for (Index& corner : t) corner = corner == 0 ? 0 : corner + 5;
    two.triangles.push_back(t);
  }
  two.vertex_count = 11;
  EXPECT_EQ(fault(two), "vertex 0: joins triangles that share no edge");
}

TEST(OrientedManifold, ATriangleThatNamesAVertexTwiceIsNot) {
  EXPECT_EQ(fault({4, {{0, 1, 2}, {1, 3, 3}}}), "triangle 1: names a vertex twice");
}

}  // namespace
}  // namespace limber::eval
