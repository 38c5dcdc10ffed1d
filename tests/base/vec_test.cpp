// SPDX-License-Identifier: Apache-2.0
#include "limber/base/vec.h"

#include <gtest/gtest.h>
#include <limits>

namespace limber {
namespace {

TEST(Vec3, CrossIsPerpendicularToBothAndFollowsTheRightHand) {
  EXPECT_EQ(cross(Vec3d{1, 0, 0}, Vec3d{0, 1, 0}), (Vec3d{0, 0, 1}));
  const Vec3d a{1, 2, 3}, b{-2, 5, 7};
  EXPECT_EQ(dot(cross(a, b), a), 0.0);
  EXPECT_EQ(dot(cross(a, b), b), 0.0);
  EXPECT_EQ(cross(b, a), -cross(a, b));
  EXPECT_EQ(squared_length(cross(a, b)), squared_length(a) * squared_length(b) - dot(a, b) * dot(a, b));
}

TEST(Vec3, ConvertsBetweenPrecisionsByRounding) {
  EXPECT_EQ(static_cast<Vec3f>(Vec3d{1.0 / 3, 0.5, -2}), (Vec3f{1.0f / 3, 0.5f, -2}));
  EXPECT_EQ(static_cast<Vec3d>(Vec3f{0.1f, 2, 3}).x, static_cast<double>(0.1f));
}

TEST(Vec3, IsFiniteOnlyIfEveryCoordinateIs) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(is_finite(Vec3f{1, -2, std::numeric_limits<float>::max()}));
  EXPECT_FALSE(is_finite(Vec3f{kInfinity, 0, 0}));
  EXPECT_FALSE(is_finite(Vec3f{0, kNan, 0}));
  EXPECT_FALSE(is_finite(Vec3f{0, 0, -kInfinity}));
}

TEST(Box, WithoutPointsIsEmptyAndHasNoDiagonal) {
  const Box box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.diagonal(), 0.0);
  EXPECT_EQ(box.center(), Vec3d{});
}

TEST(Box, AroundOnePointIsThatPoint) {
  Box box;
  box.add({1e4, -2, 3});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.diagonal(), 0.0);
  EXPECT_EQ(box.center(), (Vec3d{1e4, -2, 3}));
}

TEST(Box, IsTheSmallestAroundAllPointsInAnyOrder) {
  Box box;
  for (const Vec3d p : {Vec3d{3, 0, 0}, {0, 4, -1}, {1, 1, -13}}) box.add(p);
  EXPECT_EQ(box.low, (Vec3d{0, 0, -13}));
  EXPECT_EQ(box.high, (Vec3d{3, 4, 0}));
  EXPECT_DOUBLE_EQ(box.diagonal(), std::sqrt(9.0 + 16 + 169));
  EXPECT_EQ(box.center(), (Vec3d{1.5, 2, -6.5}));
}

}  // namespace
}  // namespace limber
