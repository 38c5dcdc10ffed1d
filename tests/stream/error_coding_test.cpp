// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/error_coding.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace limber {
namespace {

TEST(ErrorCoding, KeepsErrorsWithinASixteenth) {
  for (float error = 1e-30f; error < 1e30f; error *= 1.037f)
    EXPECT_LE(std::fabs(error_value(quantized_error(error)) - error), error / 16);
}

TEST(ErrorCoding, KeepsZeroAndNothingElseAsZero) {
  EXPECT_EQ(error_value(quantized_error(0.0f)), 0.0f);
  EXPECT_GT(error_value(quantized_error(std::numeric_limits<float>::denorm_min())), 0.0f);
  EXPECT_TRUE(std::isfinite(error_value(quantized_error(std::numeric_limits<float>::max()))));
}

TEST(ErrorCoding, ReturnsErrorsOfKeyAndStep) {
  const std::vector<std::int32_t> first{5, 0, kLargestError, 700, 701}, second{6, 1, 0, 700, 690};
  const std::vector<std::uint8_t> changed{0, 1, 0, 1, 0};
  RangeEncoder encoder;
  ErrorModels models;
  std::vector<std::int32_t> state(5);
  EXPECT_TRUE(code_errors(encoder, models, true, changed, state, [&](std::size_t i) { return first[i]; }));
  EXPECT_TRUE(code_errors(encoder, models, false, changed, state, [&](std::size_t i) { return second[i]; }));
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  models = {};
  const auto none = [](std::size_t) { return 0; };
  EXPECT_TRUE(code_errors(decoder, models, true, changed, state, none));
  EXPECT_EQ(state, first);
  EXPECT_TRUE(code_errors(decoder, models, false, changed, state, none));
  EXPECT_EQ(state, second);
}

}  // namespace
}  // namespace limber
