// SPDX-License-Identifier: Apache-2.0
#include "limber/base/facing.h"

#include <gtest/gtest.h>

namespace limber {
namespace {

const Vec3d kA{0, 0, 0}, kB{1, 0, 0}, kC{0, 1, 0};  // faces up

TEST(Facing, TellsATriangleThatFacesAwayFromItsSurface) {
  EXPECT_TRUE(is_turned_over(kA, kB, kC, {{0, 0, -1}, 1}));
  EXPECT_TRUE(is_turned_over(kA, kC, kB, {{0, 0, 1}, 1}));
  EXPECT_FALSE(is_turned_over(kA, kB, kC, {{0, 0, 1}, 1}));
  EXPECT_FALSE(is_turned_over(kA, kB, kC, {{1, 0, 0}, 1})) << "at a right angle";
  EXPECT_FALSE(is_turned_over(kA, kB, kB, {{0, 0, 1}, 1})) << "without area";
}

TEST(Facing, SaysNothingOfASurfaceThatFacesSeveralWays) {
  Facing sheet{{0, 0, -1}, 1};
  EXPECT_TRUE(is_turned_over(kA, kB, kC, sheet));
  sheet += {{0, 0, 0.5}, 0.5};  // half of its other side
  EXPECT_FALSE(is_turned_over(kA, kB, kC, sheet));
  sheet -= {{0, 0, 0.5}, 0.5};
  EXPECT_TRUE(is_turned_over(kA, kB, kC, sheet));
}

}  // namespace
}  // namespace limber
