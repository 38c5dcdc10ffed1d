// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/build_four_k.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "limber/fourface/creases.h"
#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Shape;

FourKMesh build(const Shape& shape, const FourKOptions& options = {}, const FourKTags& tags = {}) {
  return build_four_k(shape.mesh, shape.positions, options, tags);
}

std::vector<Triangle> coarsest(const FourKMesh& mesh) { return triangles_after(mesh, mesh.operation_count()); }

Shape without_faces() {
  Shape shape;
  shape.mesh.vertex_count = 3;
  shape.mesh.triangles.push_back({0, 1, 1});
  shape.positions.assign(3, Vec3f{});
  return shape;
}

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  all.push_back(test::sheet(12, 9));
  all.push_back(test::waved(test::sheet(20, 20)));
  all.push_back(test::sheet_with_hole(12, 12));
  all.push_back(test::sphere(3));
  all.push_back(test::jittered(test::torus(12, 20), 0.05f, 1));
  all.push_back(test::together(test::sphere(2), test::sheet(5, 5), 4));
  all.push_back(test::quantized(test::jittered(test::sheet(10, 10), 0.4f, 2), 4));
  all.push_back(test::tetrahedron());
  all.push_back(Shape{});
  all.push_back(without_faces());
  return all;
}

TEST(BuildFourK, KeepsEveryInvariant) {
  for (const Shape& shape : shapes()) EXPECT_EQ(validate(build(shape), shape.positions), nullptr);
}

TEST(BuildFourK, KeepsTheTopologyAfterEveryLevel) {
  for (const Shape& shape : shapes()) {
    const FourKMesh mesh = build(shape);
    const test::Invariants before = test::invariants_of(triangles_after(mesh, 0));
    for (const Index end : mesh.level_begin)
      EXPECT_TRUE(test::same_shape(test::invariants_of(triangles_after(mesh, end)), before));
  }
}

// The paper shows its plane with 186, 132, 69, 35, 19 and 6 triangles. A level at most halves them, as four faces
// become two: the last step alone takes two levels, and the others are as those of two levels on its other meshes.
TEST(BuildFourK, ReducesAPlaneOf186TrianglesAsThePaperDoes) {
  const Shape plane = test::sheet(13, 9, [](Index x, Index y) { return !(x == 11 && y >= 5) && x < 12; });
  ASSERT_EQ(plane.mesh.triangles.size(), 186u);
  const FourKMesh mesh = build(plane);
  const Index paper[] = {186, 132, 69, 35, 19, 6}, levels[] = {0, 1, 3, 5, 7, 9};
  ASSERT_GE(mesh.level_count(), 9u);
  for (int i = 0; i < 6; ++i)
    EXPECT_LE(triangles_after(mesh, mesh.level_begin[levels[i]]).size(), paper[i]) << levels[i];
}

TEST(BuildFourK, TurnsNoTriangleOfAPlaneOver) {
  const Shape plane = test::moved(test::jittered(test::sheet(20, 20), 0.3f, 3), [](Vec3f p) {
    return Vec3f{p.x, p.y, 0};
  });
  const FourKMesh mesh = build(plane);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f p = plane.positions[a];
    EXPECT_GT(cross(plane.positions[b] - p, plane.positions[c] - p).z, 0);
  }
}

TEST(BuildFourK, GivesTheSameForEveryNumberOfThreads) {
  const Shape shape = test::jittered(test::sphere(5), 0.01f, 4);
  const FourKMesh one = build(shape), three = build(shape, {.threads = 3});
  EXPECT_EQ(one.triangles, three.triangles);
  EXPECT_EQ(one.destroyed, three.destroyed);
  EXPECT_EQ(one.error, three.error);
}

TEST(BuildFourK, HasNoLongerChainsThanItMay) {
  for (const Shape& shape :
       {test::waved(test::sheet(30, 30)), test::sphere(4), test::jittered(test::torus(16, 28), 0.05f, 6)}) {
    const double logarithm = std::log2(shape.mesh.triangles.size());
    EXPECT_LE(height(build(shape)).operations, 2.5 * logarithm);
    EXPECT_LE(height(build(shape, {.height = 1})).operations, logarithm);
    EXPECT_GT(height(build(shape, {.height = 0})).operations, logarithm);
  }
}

TEST(BuildFourK, LetsGoOfItsHeightForASizeWhereItMayFold) {
  const Shape shape = test::sphere(4);
  const FourKMesh kept = build(shape, {.height = 0.5, .vertices = 40});
  const FourKMesh let_go = build(shape, {.height = 0.5, .vertices = 40, .may_fold = true});
  EXPECT_GT(coarsest(kept).size(), 2u * 76);
  EXPECT_LE(coarsest(let_go).size(), 76u);
}

TEST(BuildFourK, EndsAtTheSizeAskedFor) {
  const Shape shape = test::sphere(4);
  const FourKMesh by_vertices = build(shape, {.vertices = 100});
  EXPECT_EQ(test::invariants_of(coarsest(by_vertices)).vertex_count, 100);
  EXPECT_EQ(coarsest(build(shape, {.triangles = 300})).size(), 300u);
  EXPECT_EQ(build(shape, {.levels = 2}).level_count(), 2u);
}

TEST(BuildFourK, MakesNoClusterOfWhatItHasJustMadeInTheSameLevel) {
  const Shape shape = test::waved(test::sheet(30, 30));
  const FourKMesh mesh = build(shape, {.level_share = 0});
  for (Index level = 0; level < mesh.level_count(); ++level) {
    std::set<Index> marked;
    for (Index o = mesh.level_begin[level]; o < mesh.level_begin[level + 1]; ++o) {
      for (const Index t : mesh.destroyed_by(o)) ASSERT_FALSE(marked.contains(t));
      if (!mesh.is_removal(o)) continue;
      for (Index t = mesh.created_begin[o]; t < mesh.created_begin[o + 1]; ++t) marked.insert(t);
    }
  }
}

TEST(BuildFourK, SaysWhichNeighbourStandsForAVertex) {
  const Shape shape = test::sphere(3);
  const FourKMesh mesh = build(shape);
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    if (!mesh.is_removal(o)) continue;
    // A neighbour as it was removed, of both triangles that are left.
    for (Index t = mesh.created_begin[o]; t < mesh.created_begin[o + 1]; ++t)
      EXPECT_TRUE(std::ranges::find(mesh.triangles[t], mesh.kept(o)) != mesh.triangles[t].end());
  }
}

TEST(BuildFourK, KeepsTaggedVertices) {
  const Shape plane = test::sheet(15, 15);
  const FourKTags tags{.vertices = {16, 112, 130}, .edges = {}};
  const FourKMesh mesh = build(plane, {}, tags);
  std::set<Index> left;
  for (const Triangle& t : coarsest(mesh)) left.insert(t.begin(), t.end());
  for (const Index v : tags.vertices) EXPECT_TRUE(left.contains(v)) << v;
  EXPECT_LT(left.size(), 40u);
}

// A seam along x = 7: at the end no triangle lies on both of its sides.
TEST(BuildFourK, KeepsTaggedEdgesAsALine) {
  const Shape plane = test::sheet(15, 15);
  FourKTags tags;
  for (Index y = 0; y + 1 < 15; ++y) tags.edges.push_back({y * 15 + 7, (y + 1) * 15 + 7});
  const FourKMesh mesh = build(plane, {}, tags);
  for (const Triangle& t : mesh.triangles) {
    const auto is_left = [&](Index v) { return plane.positions[v].x < 7; };
    const auto is_right = [&](Index v) { return plane.positions[v].x > 7; };
    EXPECT_FALSE(std::ranges::any_of(t, is_left) && std::ranges::any_of(t, is_right));
  }
  EXPECT_LT(coarsest(mesh).size(), 30u);
}

// The line turns at (7, 7), in the middle of a plane, where removing a vertex costs nothing else.
TEST(BuildFourK, KeepsTheCornerOfATaggedLineToTheLast) {
  const Shape plane = test::sheet(15, 15);
  FourKTags tags;
  for (Index i = 0; i < 7; ++i) tags.edges.push_back({i * 15 + 7, (i + 1) * 15 + 7});
  for (Index i = 7; i < 14; ++i) tags.edges.push_back({7 * 15 + i, 7 * 15 + i + 1});
  std::set<Index> left;
  for (const Triangle& t : coarsest(build(plane, {.vertices = 12}, tags))) left.insert(t.begin(), t.end());
  EXPECT_TRUE(left.contains(7 * 15 + 7));
}

TEST(BuildFourK, FindsTheEdgesOfACubeForCreases) {
  Shape cube;
  cube.mesh.vertex_count = 8;
  cube.mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                         {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  cube.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  EXPECT_EQ(find_creases(cube.mesh, cube.positions, 0.5).size(), 12u);
  EXPECT_EQ(find_creases(cube.mesh, cube.positions, -0.5).size(), 0u);
}

TEST(BuildFourK, OrientsTrianglesThatFaceDifferentWays) {
  Shape shape = test::sphere(3);
  for (std::size_t t = 0; t < shape.mesh.triangles.size(); t += 3)
    std::swap(shape.mesh.triangles[t][1], shape.mesh.triangles[t][2]);
  const FourKMesh mesh = build(shape);
  EXPECT_EQ(validate(mesh, shape.positions), nullptr);
  EXPECT_LT(coarsest(mesh).size(), 60u);
}

TEST(BuildFourK, LeavesWhatIsNotManifoldAsItIs) {
  // Two sheets that share a vertex, and a third triangle on an inner edge.
  Shape shape = test::sheet(8, 8);
  shape.mesh.vertex_count += 1;
  shape.positions.push_back({3, 3, 2});
  shape.mesh.triangles.push_back({27, 28, 64});
  const FourKMesh mesh = build(shape);
  EXPECT_EQ(validate(mesh, shape.positions), nullptr);
  std::set<Index> left;
  for (const Triangle& t : coarsest(mesh)) left.insert(t.begin(), t.end());
  EXPECT_TRUE(left.contains(27) && left.contains(28));
  EXPECT_LT(left.size(), 20u);
}

TEST(BuildFourK, StopsWhenItIsAskedTo) {
  const Shape shape = test::sphere(4);
  EXPECT_EQ(build_four_k(shape.mesh, shape.positions, {}, {}, [] { return false; }).operation_count(), 0u);
}

}  // namespace
}  // namespace limber
