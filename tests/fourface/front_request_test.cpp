// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/front_request.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "limber/fourface/build_four_k.h"
#include "limber/fourface/frame_errors.h"
#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

class FrontRequests : public testing::Test {
 protected:
  std::vector<Triangle> triangles(const FrontRequest& request, std::span<const float> bend = {}) {
    move_front(front_, mesh_, shape_.positions, request, bend);
    std::vector<Triangle> corners;
    front_.list(corners);
    EXPECT_TRUE(test::same_shape(test::invariants_of(corners), test::invariants_of(triangles_after(mesh_, 0))));
    return corners;
  }
  // Of a corner of each.
  template <class Holds>
  std::size_t count_where(const std::vector<Triangle>& all, const Holds& holds) {
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](const Triangle& t) { return holds(shape_.positions[t[0]]); }));
  }

  test::Shape shape_ = test::waved(test::sheet(40, 40));
  FourKMesh mesh_ = build_four_k(shape_.mesh, shape_.positions, {});
  Front front_{mesh_};
};

TEST_F(FrontRequests, KeepsToVerticesAndTriangles) {
  for (const Index budget : {600u, 100u, 300u}) {
    triangles({.vertices = budget});
    EXPECT_LE(front_.vertex_count(), budget);
    EXPECT_GE(front_.vertex_count() + 1, budget);
    EXPECT_LE(triangles({.triangles = budget}).size(), budget);
    EXPECT_GE(front_.triangles().size() + 2, budget);
  }
}

TEST_F(FrontRequests, CountsItsVertices) {
  for (const double error : {0.01, 0.2, 0.0, 1.0}) {
    const auto corners = triangles({.error = error});
    EXPECT_EQ(front_.vertex_count(), test::invariants_of(corners).vertex_count);
  }
}

TEST_F(FrontRequests, GivesALevel) {
  EXPECT_EQ(triangles({.level = 3}).size(), triangles_after(mesh_, mesh_.level_begin[3]).size());
  EXPECT_EQ(triangles({.level = 0}).size(), mesh_.finest_count);
}

TEST_F(FrontRequests, IsFineInTheBallAlone) {
  const auto corners = triangles({.focus = Ball{{10, 10, 0}, 6}});
  const auto near = [](const Vec3f& p) { return std::hypot(p.x - 10, p.y - 10) < 5; };
  EXPECT_EQ(count_where(corners, near), count_where(triangles_after(mesh_, 0), near));
  EXPECT_LT(corners.size(), mesh_.finest_count / 2);
}

TEST_F(FrontRequests, IsFinerNearTheEyeAndCoarseBehindIt) {
  const Viewpoint view{.eye = {20, -5, 4}, .target = {20, 20, 0}, .up = {0, 0, 1}};
  const auto corners = triangles({.pixels = 4, .view = view});
  const auto near = [](const Vec3f& p) { return p.y < 8 && p.x > 16 && p.x < 24; };
  const auto far = [](const Vec3f& p) { return p.y > 30 && p.x > 16 && p.x < 24; };
  EXPECT_GT(count_where(corners, near), count_where(corners, far));
  const Viewpoint away{.eye = {20, -5, 4}, .target = {20, -30, 4}, .up = {0, 0, 1}};
  EXPECT_LT(triangles({.view = away}).size(), mesh_.finest_count / 8);
}

TEST_F(FrontRequests, SeesWhatLiesBetweenTheSidesOfThePicture) {
  const Viewpoint view{.eye = {0, 0, 5}, .target = {0, 0, 0}, .fov_degrees = 90, .width = 200, .height = 100};
  const auto sees = [&](const Vec3d& p) {
    for (const HalfSpace& half : seen_from(view))
      if (dot(half.normal, p) < half.offset) return false;
    return true;
  };
  EXPECT_TRUE(sees({0, 4.9, 0}));
  EXPECT_FALSE(sees({0, 5.1, 0}));
  EXPECT_TRUE(sees({9.9, 0, 0}));
  EXPECT_FALSE(sees({10.1, 0, 0}));
  EXPECT_FALSE(sees({0, 0, 6}));
  EXPECT_NEAR(pixels_per_slope(view), 50, 1e-9);
}

TEST_F(FrontRequests, KeepsBendsWhereItIsAskedTo) {
  const std::vector<float> bend = bends(mesh_, shape_.positions);
  for (Index o = 0; o < mesh_.operation_count(); ++o) {
    for (const Index t : mesh_.destroyed_by(o)) {
      const Index creator = mesh_.creator[t];
      ASSERT_LE(creator == kNone ? 0 : bend[creator], bend[o]);
    }
  }
  EXPECT_GT(triangles({.bend = 0.01}, bend).size(), triangles({.bend = 0.1}, bend).size());
}

TEST_F(FrontRequests, ChangesLessWithHysteresis) {
  const std::vector<Vec3f> first = shape_.positions;
  Index changes[2] = {0, 0};
  for (const int calm : {0, 1}) {
    Front front(mesh_);
    for (int frame = 0; frame < 8; ++frame) {
      std::vector<Vec3f> moved = first;
      for (Vec3f& p : moved) p.z *= 1 + 0.3f * static_cast<float>(frame % 3) * (p.x / 40);
      measure_frame(mesh_, moved);
      move_front(front, mesh_, moved, {.triangles = 400}, {}, calm == 1 ? 2 : 1);
      EXPECT_LE(front.triangles().size(), 400u);
      if (frame > 0) changes[calm] += front.changes();
    }
  }
  EXPECT_LT(changes[1], changes[0] / 2);
}

}  // namespace
}  // namespace limber
