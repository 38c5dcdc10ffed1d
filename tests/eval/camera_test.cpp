// SPDX-License-Identifier: Apache-2.0
#include "eval/camera.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace limber::eval {
namespace {

std::vector<Vec3d> corners_of(const Box& box) {
  std::vector<Vec3d> corners;
  for (int c = 0; c < 8; ++c) {
    corners.push_back({c & 1 ? box.high.x : box.low.x, c & 2 ? box.high.y : box.low.y, c & 4 ? box.high.z : box.low.z});
  }
  return corners;
}

TEST(FrameCamera, SeesTheWholeBoxFromEveryDirectionAndTouchesTheMarginOnce) {
  const Box box{{-3.0, 1.0, 10.0}, {5.0, 2.0, 12.5}};
  for (const Vec3d direction :
       {Vec3d{0, 0, 1}, Vec3d{1, 0.3, 0.2}, Vec3d{-1, -2, 0.5}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}}) {
    for (const double aspect : {0.5, 4.0 / 3.0, 3.0}) {
      const int height = 600, width = static_cast<int>(height * aspect);
      const Projection projection(frame_camera(box, direction, aspect, {.margin = 0.1}), width, height);
      double nearest = 1.0;  // to the frame, as a share of the picture
      for (const Vec3d& corner : corners_of(box)) {
        const ScreenPoint p = projection.project(corner);
        ASSERT_GT(p.w, 0.0);
        const double x = p.x / p.w / width, y = p.y / p.w / height;
        nearest = std::min({nearest, x, y, 1.0 - x, 1.0 - y});
      }
      EXPECT_NEAR(nearest, 0.1, 1e-9);
    }
  }
}

TEST(FrameCamera, StandsSomewhereSensibleForAnEmptyBoxAndForAPoint) {
  EXPECT_TRUE(is_finite(frame_camera(Box{}, {0, 0, 1}, 1.0).eye));
  Box point;
  point.add({3, 4, 5});
  const Camera camera = frame_camera(point, {0, 0, 1}, 1.0);
  EXPECT_GT(camera.eye.z, 5.0);
  EXPECT_EQ(camera.target, (Vec3d{3, 4, 5}));
}

TEST(Projection, PutsTheTargetInTheMiddleAndUpUpwards) {
  const Camera camera{.eye = {0, 0, 10}, .target = {}, .up = {0, 1, 0}, .fov_degrees = 90.0};
  const Projection projection(camera, 200, 100);
  const ScreenPoint middle = projection.project({});
  EXPECT_NEAR(middle.x / middle.w, 100.0, 1e-12);
  EXPECT_NEAR(middle.y / middle.w, 50.0, 1e-12);
  const ScreenPoint top = projection.project({0, 10, 0});  // 45 degrees up: the upper border of the picture
  EXPECT_NEAR(top.y / top.w, 0.0, 1e-9);
  const ScreenPoint right = projection.project({10, 0, 0});
  EXPECT_NEAR(right.x / right.w, 150.0, 1e-9);
}

TEST(Projection, SendsARayThroughThePlaceWherePointsAppear) {
  const Projection projection({.eye = {3, 2, 9}, .target = {1, 0, 0}}, 320, 240);
  const Vec3d p{0.5, -0.25, 1.5};
  const ScreenPoint s = projection.project(p);
  const Vec3d back = projection.eye() + projection.ray(s.x / s.w, s.y / s.w) * s.w;
  EXPECT_NEAR(length(back - p), 0.0, 1e-12);
}

}  // namespace
}  // namespace limber::eval
