// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/orientation.h"

#include <gtest/gtest.h>
#include <utility>

#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

Mesh turned_at_random(Mesh mesh, std::uint64_t seed) {
  test::Random random(seed);
  for (std::size_t t = 1; t < mesh.triangles.size(); ++t)
    if (random.below(2) == 1) std::swap(mesh.triangles[t][0], mesh.triangles[t][2]);
  return mesh;
}

TEST(OrientAlike, LeavesASurfaceThatIsOrientedAsItIs) {
  for (const test::Shape& shape : {test::sphere(3), test::torus(8, 9), test::sheet_with_hole(9, 9)}) {
    Mesh mesh = shape.mesh;
    orient_alike(mesh);
    EXPECT_EQ(mesh, shape.mesh);
  }
}

TEST(OrientAlike, TurnsTrianglesAsTheFirstOfTheirPartFaces) {
  const test::Shape shape = test::together(test::torus(8, 9), test::sphere(2), 20);
  Mesh mesh = turned_at_random(shape.mesh, 1);
  ASSERT_FALSE(test::invariants_of(mesh.triangles).is_oriented);
  orient_alike(mesh);
  EXPECT_TRUE(test::invariants_of(mesh.triangles).is_oriented);
  EXPECT_EQ(mesh.triangles[0], shape.mesh.triangles[0]);
}

TEST(OrientAlike, DoesNotReachAcrossAnEdgeOfThreeTriangles) {
  Mesh mesh{5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  const Mesh given = mesh;
  orient_alike(mesh);
  EXPECT_EQ(mesh, given);
}

TEST(OrientAlike, EndsOnASurfaceWithOneSide) {
  Mesh band{10, {}};  // five squares in a ring, the last of them twisted
  for (Index i = 0; i < 5; ++i) {
    const Index a = 2 * i, b = a + 1, c = i < 4 ? a + 2 : 1, d = i < 4 ? a + 3 : 0;
    band.triangles.push_back({a, b, d});
    band.triangles.push_back({a, d, c});
  }
  orient_alike(band);
  EXPECT_EQ(band.triangles.size(), 10u);
  EXPECT_FALSE(test::invariants_of(band.triangles).is_oriented);
}

TEST(OrientAlike, PassesByTrianglesThatAreDegenerateOrThereTwice) {
  Mesh mesh{4, {{0, 1, 2}, {0, 1, 2}, {2, 2, 3}, {0, 0, 0}}};
  orient_alike(mesh);
  EXPECT_EQ(mesh.triangles[2], (Triangle{2, 2, 3}));
  Mesh nothing;
  orient_alike(nothing);
  EXPECT_TRUE(nothing.triangles.empty());
}

}  // namespace
}  // namespace limber
