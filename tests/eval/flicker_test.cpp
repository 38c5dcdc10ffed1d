// SPDX-License-Identifier: Apache-2.0
#include "eval/flicker.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

const SampleOptions kFew{.per_triangle = 1, .at_least = 5000};
const double kPercent = 100 / std::sqrt(2);  // of the unit square

TEST(Flicker, SaysNothingBeforeTheSecondFrame) {
  Flicker flicker(kFew);
  EXPECT_EQ(flicker.value(), std::nullopt);
  EXPECT_EQ(flicker.add(test::square(4), ClosestPointTree(test::square(4))), std::nullopt);
  EXPECT_EQ(flicker.value(), std::nullopt);
}

TEST(Flicker, IsTheMoveOfAnApproximationThatRisesAndFalls) {
  const Shape original = test::square(4);
  Flicker flicker(kFew);
  flicker.add(original, ClosestPointTree(test::square(2, 0)));
  EXPECT_NEAR(*flicker.add(original, ClosestPointTree(test::square(2, 0.125f))), kPercent / 8, 1e-9);
  // Through to the other side: the sign counts.
  EXPECT_NEAR(*flicker.add(original, ClosestPointTree(test::square(2, -0.125f))), kPercent / 4, 1e-9);
  EXPECT_NEAR(*flicker.value(), kPercent * 3 / 16, 1e-9);
}

TEST(Flicker, IsNothingWhereTheErrorMovesWithTheSurface) {
  const Shape original = test::square(4), approximation = test::square(2, 0.25f);
  Flicker flicker(kFew);
  for (const float step : {0.0f, 0.5f, 3.0f, -2.0f}) {
    const Shape there = test::shifted(original, {step, 2 * step, step});
    flicker.add(there, ClosestPointTree(test::shifted(approximation, {step, 2 * step, step})));
  }
  EXPECT_LT(*flicker.value(), 1e-9);
}

TEST(Flicker, IsNothingWhereBothTurn) {
  const Shape original = test::sphere(16), approximation = test::sphere(5);
  const auto turned = [](const Shape& shape) {
    return test::moved(shape, [](Vec3f p) { return Vec3f{-p.y, p.x, p.z}; });
  };
  Flicker flicker(kFew);
  flicker.add(original, ClosestPointTree(approximation));
  EXPECT_LT(*flicker.add(turned(original), ClosestPointTree(turned(approximation))), 1e-9);
}

TEST(Flicker, ScalesByTheFirstFrame) {
  const Shape original = test::square(4);
  Flicker flicker(kFew);
  flicker.add(original, ClosestPointTree(original));
  const Shape larger = test::scaled(original, 8);
  EXPECT_NEAR(*flicker.add(larger, ClosestPointTree(test::shifted(larger, {0, 0, 1}))), kPercent, 1e-9);
}

TEST(Flicker, LeavesOutTrianglesThatCollapse) {
  // The second half of the square folds into a line in frame 1 and comes back in frame 2.
  const Shape original = test::square(2);
  const Shape collapsed = test::moved(original, [](Vec3f p) { return Vec3f{std::min(p.x, 0.5f), p.y, p.z}; });
  Flicker flicker(kFew);
  flicker.add(original, ClosestPointTree(test::square(2, 0.5f)));
  EXPECT_NEAR(*flicker.add(collapsed, ClosestPointTree(test::square(2, 0.25f))), kPercent / 4, 1e-9);
  EXPECT_NEAR(*flicker.add(original, ClosestPointTree(test::square(2, 0.25f))), 0, 1e-9);
}

TEST(Flicker, GivesTheSameForEveryNumberOfThreads) {
  const auto run = [] {
    Flicker flicker(kFew);
    flicker.add(test::sphere(16), ClosestPointTree(test::sphere(6)));
    return *flicker.add(test::sphere(16), ClosestPointTree(test::sphere(5)));
  };
  const double all = run();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(run(), all);
  EXPECT_GT(all, 0);
}

}  // namespace
}  // namespace limber::eval
