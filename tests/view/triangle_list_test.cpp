// SPDX-License-Identifier: Apache-2.0
#include "limber/view/triangle_list.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "limber/view/cut.h"
#include "tests/view/allocations.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

using test::Surface;

// A state of two levels with these clusters; nothing but labels matters here.
FrameState state_of(Index vertex_count, std::vector<Index> parents, Index coarse_count) {
  FrameState state;
  state.hierarchy.level_begin = {0, vertex_count, vertex_count + coarse_count};
  state.hierarchy.parent = std::move(parents);
  state.hierarchy.parent.resize(vertex_count + coarse_count, kNone);
  state.positions.resize(vertex_count + coarse_count);
  state.errors.assign(vertex_count + coarse_count, 0.0f);
  return state;
}

TriangleList list_level(const Mesh& mesh, const FrameState& state, Index level) {
  Cut cut(mesh, state.hierarchy, {.by = CutBy::kLevel, .level = level});
  cut.update(mesh, state);
  TriangleList list;
  list_triangles(mesh, cut.labels(), list);
  return list;
}

using Triangles = std::vector<Triangle>;
using Faces = std::vector<Index>;

TEST(TriangleList, KeepsOrderAndOrientationOfTheFinestTriangles) {
  //   3---4---5      clusters 6 = {0}  7 = {1, 2}  8 = {3}  9 = {4, 5}
  //   | / | / |
  //   0---1---2
  const Mesh mesh{6, {{0, 1, 4}, {4, 3, 0}, {1, 2, 5}, {5, 4, 1}}};
  const FrameState state = state_of(6, {6, 7, 7, 8, 9, 9}, 4);
  const TriangleList list = list_level(mesh, state, 1);
  EXPECT_EQ(list.triangles, Triangles({{6, 7, 9}, {9, 8, 6}}));
  EXPECT_EQ(list.faces, Faces({0, 1}));
  EXPECT_EQ(list_level(mesh, state, 0).triangles, mesh.triangles);
}

TEST(TriangleList, GivesEqualImagesOnceWhereverTheyBegin) {
  const Mesh mesh{6, {{0, 2, 4}, {5, 1, 3}, {2, 4, 1}, {0, 4, 2}, {1, 5, 3}}};
  const FrameState state = state_of(6, {6, 6, 7, 7, 8, 8}, 3);
  const TriangleList list = list_level(mesh, state, 1);
  EXPECT_EQ(list.triangles, Triangles({{6, 7, 8}, {6, 8, 7}})) << "both sides of a fold are kept";
  EXPECT_EQ(list.faces, Faces({0, 3}));
}

TEST(TriangleList, KeepsTheRepetitionsOfTheInputWhereItIsFinest) {
  const Mesh mesh{4, {{0, 1, 2}, {1, 2, 0}, {0, 1, 2}, {1, 2, 3}, {3, 3, 1}}};
  const FrameState state = state_of(4, {4, 5, 6, 6}, 3);
  EXPECT_EQ(list_level(mesh, state, 0).triangles, Triangles({{0, 1, 2}, {1, 2, 0}, {0, 1, 2}, {1, 2, 3}}));
  EXPECT_EQ(list_level(mesh, state, 1).triangles, Triangles({{4, 5, 6}}));
}

TEST(TriangleList, OfANonManifoldEdgeKeepsAllItsTriangles) {
  const Mesh mesh{6, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {0, 1, 5}}};
  const FrameState state = state_of(6, {6, 7, 8, 9, 10, 10}, 5);
  EXPECT_EQ(list_level(mesh, state, 1).triangles, Triangles({{6, 7, 8}, {7, 6, 9}, {6, 7, 10}}));
}

TEST(TriangleList, OfAMeshWithoutTrianglesIsEmpty) {
  const Mesh mesh{3, {}};
  const FrameState state = state_of(3, {3, 3, 4}, 2);
  EXPECT_TRUE(list_level(mesh, state, 1).triangles.empty());
}

// The definition, word by word.
Triangles plain_list(const Mesh& mesh, const Cut& cut) {
  Triangles triangles;
  std::set<Triangle> seen;
  for (const Triangle& t : mesh.triangles) {
    Triangle image{cut.labels()[t[0]], cut.labels()[t[1]], cut.labels()[t[2]]};
    if (image[0] == image[1] || image[1] == image[2] || image[2] == image[0]) continue;
    Triangle key = image;
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    const bool finest = *std::max_element(image.begin(), image.end()) < mesh.vertex_count;
    if (seen.insert(key).second || finest) triangles.push_back(image);
  }
  return triangles;
}

TEST(TriangleList, UsedAgainForEveryFrameIsWhatTheDefinitionSays) {
  for (const bool closed : {false, true}) {
    const Surface s = closed ? test::torus(30, 31) : test::sheet(30, 31);
    FrameState state = test::patch_state(s, {930, 120, 30, 5});
    Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = 200});
    test::Random random(11);
    TriangleList list;
    for (int frame = 0; frame < 100; ++frame) {
      cut.set_options({.by = CutBy::kVertices, .budget = 20 + random.below(700)});
      cut.update(s.mesh, state);
      list_triangles(s.mesh, cut.labels(), list);
      ASSERT_EQ(list.triangles, plain_list(s.mesh, cut));
      ASSERT_EQ(list.faces.size(), list.triangles.size());
      for (std::size_t i = 0; i < list.faces.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
          ASSERT_EQ(list.triangles[i][corner], cut.labels()[s.mesh.triangles[list.faces[i]][corner]]);
        }
      }
      test::deform(s.mesh, state, 60, random);
    }
  }
}

// Images all of whose finest triangles are among those asked for are listed as they are in the whole list.
TEST(TriangleList, AroundVerticesListsWhatFollowsFromTheirTriangles) {
  const Surface surface = test::torus(16, 24);
  FrameState state = test::patch_state(surface, {384, 96, 24});
  Cut cut(surface.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = 60});
  cut.update(surface.mesh, state);
  TriangleList whole, around, expected;
  list_triangles(surface.mesh, cut.labels(), whole);
  const Index node = whole.triangles[whole.triangles.size() / 2][0];
  std::vector<std::uint8_t> vertices(surface.mesh.vertex_count, 0);
  for (Index v = 0; v < surface.mesh.vertex_count; ++v) vertices[v] = cut.labels()[v] == node;
  list_triangles_around(surface.mesh, cut.labels(), vertices, around);
  for (std::size_t i = 0; i < whole.triangles.size(); ++i) {
    const Triangle& t = whole.triangles[i];
    if (std::find(t.begin(), t.end(), node) == t.end()) continue;
    expected.triangles.push_back(t);
    expected.faces.push_back(whole.faces[i]);
  }
  ASSERT_FALSE(expected.triangles.empty());
  std::size_t found = 0;
  for (std::size_t i = 0; i < around.triangles.size(); ++i) {
    const Triangle& t = around.triangles[i];
    if (std::find(t.begin(), t.end(), node) == t.end()) continue;
    ASSERT_LT(found, expected.triangles.size());
    EXPECT_EQ(t, expected.triangles[found]);
    EXPECT_EQ(around.faces[i], expected.faces[found++]);
  }
  EXPECT_EQ(found, expected.triangles.size());
  list_triangles_around(surface.mesh, cut.labels(), std::vector<std::uint8_t>(384, 1), around);
  EXPECT_EQ(around.triangles, whole.triangles);
  EXPECT_EQ(around.faces, whole.faces);
  list_triangles_around(surface.mesh, cut.labels(), std::vector<std::uint8_t>(384, 0), around);
  EXPECT_TRUE(around.triangles.empty());
}

TEST(TriangleList, IsNoLongerThanATriangleBudget) {
  const Surface s = test::torus(30, 40);
  FrameState state = test::patch_state(s, {1200, 150, 20});
  test::Random random(2);
  for (int frame = 0; frame < 20; ++frame) {
    for (const Index budget : {100u, 333u, 1000u, 2400u}) {
      Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kTriangles, .budget = budget});
      cut.update(s.mesh, state);
      TriangleList list;
      list_triangles(s.mesh, cut.labels(), list);
      EXPECT_LE(list.triangles.size(), budget);
      EXPECT_GT(list.triangles.size(), budget * 3 / 4);
    }
    test::deform(s.mesh, state, 20, random);
  }
}

TEST(TriangleList, DoesNotAllocateOnceItHasBeenAsLong) {
  const Surface s = test::sheet(30, 31);
  FrameState state = test::patch_state(s, {930, 120, 30, 5});
  Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kLevel, .level = 0});
  TriangleList list;
  cut.update(s.mesh, state);
  list_triangles(s.mesh, cut.labels(), list);
  cut.set_options({.by = CutBy::kVertices, .budget = 300});
  test::Random random(1);
  for (int frame = 0; frame < 20; ++frame) {
    test::deform(s.mesh, state, 60, random);
    cut.update(s.mesh, state);
    const std::size_t before = test::allocation_count();
    list_triangles(s.mesh, cut.labels(), list);
    EXPECT_EQ(test::allocation_count(), before);
  }
}

}  // namespace
}  // namespace limber
