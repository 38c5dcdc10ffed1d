// SPDX-License-Identifier: Apache-2.0
#include "limber/view/downhill.h"

#include <gtest/gtest.h>

#include "tests/view/patches.h"

namespace limber {
namespace {

constexpr float kNearest = 0;  // no distance is near enough to stop at

struct FlatGrid {
  test::Surface surface = test::sheet(12, 12);
  Stars stars{surface.mesh};

  FlatGrid() {
    for (Vec3f& p : surface.positions) p.z = 0;
  }
  NearFace walk(const Vec3f& point, Index start, float enough = kNearest) const {
    return walk_downhill(surface.mesh, stars, surface.positions, point, start, enough);
  }
};

TEST(WalkDownhill, ReachesTheTriangleBelowAPointFromAnywhereOnAFlatSheet) {
  const FlatGrid grid;
  const Vec3f point{7.4f, 3.3f, 0.5f};
  for (Index start = 0; start < grid.surface.mesh.vertex_count; ++start) {
    const NearFace near = grid.walk(point, start);
    ASSERT_NE(near.face, kNone);
    EXPECT_FLOAT_EQ(near.square, 0.25f) << start;
    EXPECT_EQ(squared_distance_to_face(grid.surface.mesh, grid.surface.positions, point, near.face), near.square);
  }
}

TEST(WalkDownhill, EndsNoFartherAwayThanItBegins) {
  const test::Surface torus = test::torus(20, 30);
  const Stars stars(torus.mesh);
  test::Random random(7);
  for (int i = 0; i < 500; ++i) {
    const float x = 10 * random.unit() - 5, y = 10 * random.unit() - 5, z = 4 * random.unit() - 2;
    const Index start = random.below(torus.mesh.vertex_count);
    const NearFace near = walk_downhill(torus.mesh, stars, torus.positions, {x, y, z}, start, kNearest);
    float around_start = std::numeric_limits<float>::infinity(), around_end = around_start;
    for (const Index face : stars.of(start))
      around_start = std::min(around_start, squared_distance_to_face(torus.mesh, torus.positions, {x, y, z}, face));
    EXPECT_LE(near.square, around_start);
    for (const Index corner : torus.mesh.triangles[near.face])
      for (const Index face : stars.of(corner))
        around_end = std::min(around_end, squared_distance_to_face(torus.mesh, torus.positions, {x, y, z}, face));
    EXPECT_EQ(near.square, around_end) << "there is nothing nearer around where it ends";
  }
}

TEST(WalkDownhill, StopsWhereItIsNearEnough) {
  const FlatGrid grid;
  const Vec3f point{10.5f, 5.2f, 0};
  const NearFace near = grid.walk(point, 5 * 12 + 1, 16.0f);
  EXPECT_LE(near.square, 16);
  EXPECT_GT(near.square, 4);
}

TEST(WalkDownhill, FindsNothingFromAVertexWithoutTriangles) {
  const Mesh mesh{4, {{0, 1, 2}}};
  const Stars stars(mesh);
  const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_EQ(walk_downhill(mesh, stars, positions, {0, 0, 0}, 3, kNearest).face, kNone);
}

}  // namespace
}  // namespace limber
