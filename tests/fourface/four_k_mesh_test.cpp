// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/four_k_mesh.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/fourface/build_four_k.h"
#include "tests/support/shapes.h"

namespace limber {
namespace {

using testing::ElementsAre;

// A hexagon's centre, 0: two swaps that do not depend on each other, and the removal.
FourKMesh hexagon() {
  FourKMesh mesh;
  mesh.vertex_count = 7;
  mesh.finest_count = 6;
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1},
                    {0, 1, 3}, {1, 2, 3}, {0, 5, 1}, {5, 6, 1}, {1, 3, 4}, {1, 4, 5}};
  mesh.creator = {kNone, kNone, kNone, kNone, kNone, kNone, 0, 0, 1, 1, 2, 2};
  mesh.destroyer = {0, 0, 2, 2, 1, 1, 2, kNone, 2, kNone, kNone, kNone};
  mesh.created_begin = {6, 8, 10, 12};
  mesh.destroyed_begin = {0, 2, 4, 8};
  mesh.destroyed = {0, 1, 4, 5, 6, 2, 3, 8};
  mesh.vertex = {0, 0, 0};
  mesh.error = {0, 0, 0};
  mesh.radius = {3, 3, 7};
  mesh.level_begin = {0, 3};
  return mesh;
}

TEST(FourKMesh, GivesTheTrianglesAfterEachOperation) {
  const FourKMesh mesh = hexagon();
  EXPECT_EQ(triangles_after(mesh, 0).size(), 6u);
  EXPECT_EQ(triangles_after(mesh, 2).size(), 6u);
  EXPECT_THAT(triangles_after(mesh, 3),
              ElementsAre(Triangle{1, 2, 3}, Triangle{5, 6, 1}, Triangle{1, 3, 4}, Triangle{1, 4, 5}));
}

TEST(FourKMesh, CountsTheSwapsForAVertexAndItsRemovalAsOneCluster) {
  const FourKHeight found = height(hexagon());
  EXPECT_EQ(found.operations, 2u);
  EXPECT_EQ(found.clusters, 1u);
}

TEST(FourKMesh, FindsHowManyOperationsASizeTakes) {
  const FourKMesh mesh = hexagon();
  EXPECT_EQ(operations_to_vertices(mesh, 7), 0u);
  EXPECT_EQ(operations_to_vertices(mesh, 6), 3u);
  EXPECT_EQ(operations_to_vertices(mesh, 1), 3u);
  EXPECT_EQ(operations_to_triangles(mesh, 6), 0u);
  EXPECT_EQ(operations_to_triangles(mesh, 5), 3u);
}

TEST(FourKMesh, IsNoHigherThanTheLogarithmOfItsTrianglesAllows) {
  for (const int depth : {3, 4, 5, 6}) {
    const test::Shape shape = test::jittered(test::sphere(depth), 0.01f, 5);
    const FourKMesh mesh = build_four_k(shape.mesh, shape.positions, {});
    EXPECT_LE(height(mesh).clusters, 2.5 * std::log2(mesh.finest_count)) << depth;
  }
}

}  // namespace
}  // namespace limber
