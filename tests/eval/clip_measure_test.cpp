// SPDX-License-Identifier: Apache-2.0
#include "eval/clip_measure.h"

#include <gtest/gtest.h>

#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

const ClipMeasureOptions kFew{.distance = {.samples = {.per_triangle = 1, .at_least = 2000}}, .first_frame_number = 7};
const double kPercent = 100 / std::sqrt(2);

TEST(ClipMeasure, IsZeroBeforeTheFirstFrame) {
  const ClipMeasure measure;
  EXPECT_TRUE(measure.frames().empty());
  EXPECT_EQ(measure.summary().rms.mean, 0);
  EXPECT_FALSE(measure.summary().flicker);
}

TEST(ClipMeasure, GivesEveryMeasureOfEachFrame) {
  const Shape original = test::square(4);
  ClipMeasure measure(kFew);
  const Shape first = test::square(1, 0.125f), second = test::square(1, 0.25f);
  const FrameMeasure frame = measure.add(original, first, first.triangles);
  EXPECT_EQ(frame.number, 7u);
  EXPECT_NEAR(frame.distance.rms, kPercent / 8, 1e-9);
  EXPECT_EQ(frame.quality.triangle_count, 2u);
  EXPECT_EQ(frame.flicker, std::nullopt);
  EXPECT_EQ(frame.changed, std::nullopt);

  const std::vector<Triangle> ids = {{0, 1, 3}, {4, 5, 6}};
  const FrameMeasure next = measure.add(original, second, ids);
  EXPECT_EQ(next.number, 8u);
  EXPECT_NEAR(next.distance.rms, kPercent / 4, 1e-9);
  EXPECT_NEAR(next.flicker.value(), kPercent / 8, 1e-9);
  EXPECT_EQ(next.changed, 0.5);
}

TEST(ClipMeasure, SaysNothingAboutChangedTrianglesWithoutIds) {
  const Shape square = test::square(4);
  ClipMeasure measure(kFew);
  measure.add(square, square, {});
  EXPECT_EQ(measure.add(square, square, {}).changed, std::nullopt);
  EXPECT_FALSE(measure.summary().changed);
  EXPECT_TRUE(measure.summary().flicker);
}

TEST(ClipMeasure, FlickerIsThatOfAllFramesFromTheFirst) {
  const Shape original = test::sphere(12);
  ClipMeasure measure(kFew);
  Flicker flicker(kFew.distance.samples);
  for (const Index steps : {4u, 5u, 5u, 7u}) {
    const Shape approximation = test::sphere(steps);
    EXPECT_EQ(measure.add(original, approximation, {}).flicker, flicker.add(original, ClosestPointTree(approximation)));
  }
  EXPECT_GT(measure.frames()[3].flicker, 0);
}

TEST(ClipMeasure, SummarisesByMeanPercentileAndWorst) {
  const Shape original = test::square(2);
  ClipMeasure measure(kFew);
  for (int t = 1; t <= 40; ++t) {
    measure.add(original, test::square(1, static_cast<float>(t) / 64), {});
  }
  const Statistic rms = measure.summary().rms;
  EXPECT_NEAR(rms.mean, kPercent * 20.5 / 64, 1e-9);
  EXPECT_NEAR(rms.percentile_95, kPercent * 38 / 64, 1e-9);
  EXPECT_NEAR(rms.worst, kPercent * 40 / 64, 1e-9);
  EXPECT_NEAR(measure.summary().flicker->mean, kPercent / 64, 1e-9);
  EXPECT_EQ(measure.summary().triangle_count.worst, 2);
}

}  // namespace
}  // namespace limber::eval
