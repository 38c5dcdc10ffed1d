// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/local_motion.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

const Shape kBall = test::jittered(test::sphere(3), 0.05f, 11);

std::vector<LocalMotion> motions_to(const Shape& moved) {
  std::vector<LocalMotion> motions(kBall.mesh.vertex_count);
  LocalMotions(kBall.mesh, kBall.positions).fit(moved.positions, motions);
  return motions;
}

TEST(LocalMotions, FindARotation) {
  // By the angle with cosine 0.6 about z, then by a right angle about x, and away.
  const auto turn = [](Vec3f p) { return Vec3f{0.6f * p.x - 0.8f * p.y, -p.z, 0.8f * p.x + 0.6f * p.y}; };
  for (const LocalMotion& motion : motions_to(moved(kBall, [&](Vec3f p) { return turn(p) + Vec3f{3, 0, -5}; }))) {
    EXPECT_LT(length(motion.axes[0] - Vec3d{0.6, 0, 0.8}), 1e-4);
    EXPECT_LT(length(motion.axes[1] - Vec3d{-0.8, 0, 0.6}), 1e-4);
    EXPECT_LT(length(motion.axes[2] - Vec3d{0, -1, 0}), 1e-4);
    EXPECT_LT(motion.deformation, 1e-4);
  }
}

TEST(LocalMotions, FindHalfATurn) {
  for (const LocalMotion& motion : motions_to(moved(kBall, [](Vec3f p) { return Vec3f{-p.x, p.y, -p.z}; }))) {
    EXPECT_LT(length(motion.axes[0] - Vec3d{-1, 0, 0}), 1e-6);
    EXPECT_LT(length(motion.axes[1] - Vec3d{0, 1, 0}), 1e-6);
  }
}

TEST(LocalMotions, AScalingIsADeformationAndNoRotation) {
  for (const LocalMotion& motion : motions_to(moved(kBall, [](Vec3f p) { return p * 1.25f; }))) {
    EXPECT_LT(length(motion.axes[0] - Vec3d{1, 0, 0}), 1e-6);
    EXPECT_NEAR(motion.deformation, 0.25, 1e-6);
  }
}

TEST(LocalMotions, AMirrorImageIsADeformationAndItsAxesStillARotation) {
  for (const LocalMotion& motion : motions_to(moved(kBall, [](Vec3f p) { return Vec3f{-p.x, p.y, p.z}; })))
    EXPECT_NEAR(dot(cross(motion.axes[0], motion.axes[1]), motion.axes[2]), 1, 1e-9);
}

TEST(LocalMotions, AVertexWithoutEdgesStaysAsItIs) {
  const Mesh mesh{.vertex_count = 4, .triangles = {{0, 1, 2}}};
  const std::vector<Vec3f> rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}},
      now{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {9, 9, 9}};
  std::vector<LocalMotion> motions(4);
  LocalMotions(mesh, rest).fit(now, motions);
  EXPECT_EQ(motions[3].axes, LocalMotion{}.axes);
  EXPECT_EQ(motions[3].deformation, 0);
  EXPECT_LT(length(motions[0].axes[0] - Vec3d{0, 1, 0}), 1e-9);
}

}  // namespace
}  // namespace limber::eval
