// SPDX-License-Identifier: Apache-2.0
#include "limber/view/camera.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "tests/view/patches.h"

namespace limber {
namespace {

void expect_near(const Vec3d& a, const Vec3d& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
  EXPECT_NEAR(a.z, b.z, 1e-12);
}

void expect_orthonormal(const CameraAxes& axes) {
  EXPECT_NEAR(length(axes.right), 1, 1e-12);
  EXPECT_NEAR(length(axes.up), 1, 1e-12);
  EXPECT_NEAR(length(axes.back), 1, 1e-12);
  expect_near(cross(axes.right, axes.up), axes.back);
}

TEST(Camera, LooksAlongMinusZWithXToTheRightWhereItIsNotTurned) {
  const CameraAxes axes = camera_axes(Camera{});
  expect_near(axes.right, {1, 0, 0});
  expect_near(axes.up, {0, 1, 0});
  expect_near(axes.back, {0, 0, 1});
}

TEST(Camera, HasTheWorldsUpAboveTheTargetInThePicture) {
  const Vec3d up{0, 0, 1};
  const CameraAxes axes = camera_axes(Camera{.eye = {10, 0, 3}, .target = {2, 0, 1}, .up = up});
  expect_near(axes.right, {0, 1, 0});
  EXPECT_GT(dot(axes.up, up), 0.9);
}

TEST(Camera, HasOrthonormalAxesWhereverTheEyeIs) {
  test::Random random(3);
  const auto coordinate = [&] { return 20.0 * double{random.unit()} - 10.0; };
  for (int i = 0; i < 1000; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate(), u = coordinate(), v = coordinate();
    const CameraAxes axes = camera_axes(Vec3d{x, y, z}, Vec3d{u, v, 1});
    expect_orthonormal(axes);
    EXPECT_NEAR(dot(axes.right, Vec3d{u, v, 1}), 0, 1e-9);  // the horizon is level
  }
}

TEST(Camera, HasAxesWhereUpIsTheLineOfSight) {
  for (const Vec3d& up : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}, Vec3d{0, 0, -2}, Vec3d{1, 1, 1}}) {
    const CameraAxes axes = camera_axes(up, up);
    expect_orthonormal(axes);
    expect_near(axes.back, up * (1 / length(up)));
  }
}

TEST(Camera, HasAxesWhereADirectionHasNoLengthOrNoEnd) {
  const double infinity = std::numeric_limits<double>::infinity();
  expect_orthonormal(camera_axes(Vec3d{}, Vec3d{}));
  expect_orthonormal(camera_axes(Vec3d{0, 3, 0}, Vec3d{}));
  expect_orthonormal(camera_axes(Vec3d{infinity, 0, 0}, Vec3d{0, infinity, 0}));
}

TEST(TangentOfHalf, IsTheTangent) {
  for (const double degrees : {0.01, 1.0, 24.0, 60.0, 90.0, 119.0, 120.0})
    EXPECT_NEAR(tangent_of_half(degrees), std::tan(degrees * std::acos(-1.0) / 360), 1e-14 * degrees) << degrees;
}

TEST(TangentOfHalf, IsThatOfTheNearestAngleThatAPictureCanHave) {
  EXPECT_EQ(tangent_of_half(-5), tangent_of_half(0.01));
  EXPECT_EQ(tangent_of_half(500), tangent_of_half(120));
}

}  // namespace
}  // namespace limber
