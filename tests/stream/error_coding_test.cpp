// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/error_coding.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

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

class ErrorCodingOfFrames : public ::testing::TestWithParam<std::size_t> {};  // by number of nodes

TEST_P(ErrorCodingOfFrames, GivesThemBack) {
  std::mt19937 random(3);
  const std::size_t count = GetParam();
  ErrorState writing(count), reading(count);
  std::vector<std::int32_t> errors(count, 0);
  std::vector<std::uint8_t> changed(count);
  for (int frame = 0; frame < 5; ++frame) {
    const bool key = frame % 3 == 0;
    for (std::size_t i = 0; i < count; ++i) {
      changed[i] = random() % 4 == 0;
      errors[i] = random() % 5 == 0 ? 0 : static_cast<std::int32_t>(random() >> random() % 16) & kLargestError;
    }
    ResidualWriter writer(key ? writing.key_statistics : writing.step_statistics);
    EXPECT_TRUE(code_errors(writer, writing, key, changed, [&](std::size_t i) { return errors[i]; }));
    const auto bytes = writer.finish();
    ResidualReader reader(bytes, key ? reading.key_statistics : reading.step_statistics);
    ASSERT_TRUE(code_errors(reader, reading, key, changed, [](std::size_t) { return 0; }));
    EXPECT_TRUE(reader.consistent());
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(reading.nodes[i].error, errors[i]) << frame << ' ' << i;
    for (ErrorState* state : {&writing, &reading}) {
      state->key_statistics.update();
      state->step_statistics.update();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(WholeThreesAndOthers, ErrorCodingOfFrames, ::testing::Values(1, 2, 3, 300, 301, 302));

TEST(ErrorCoding, RefusesAnErrorOutsideItsRange) {
  for (const std::int32_t outside : {-1, kLargestError + 1}) {
    for (const bool key : {true, false}) {
      ErrorState writing(4), reading(4);
      const std::vector<std::uint8_t> changed(4);
      ResidualWriter writer(writing.key_statistics);
      code_errors(writer, writing, key, changed, [&](std::size_t i) { return i == 2 ? outside : 7; });
      const auto bytes = writer.finish();
      ResidualReader reader(bytes, reading.key_statistics);
      EXPECT_FALSE(code_errors(reader, reading, key, changed, [](std::size_t) { return 0; })) << outside << key;
    }
  }
}

TEST(ErrorCoding, HasATableOfItsOwnForNodesWithoutAnError) {
  for (std::uint32_t neighborhood = 0; neighborhood < 100; ++neighborhood) {
    EXPECT_EQ(error_table({0, 5}, false, neighborhood), 1u);
    EXPECT_NE(error_table({1, 5}, false, neighborhood), 1u);
    EXPECT_LT(error_table({1, 5}, false, neighborhood), 12u);
    EXPECT_GE(error_table({0, 5}, true, neighborhood), 12u);
    EXPECT_LT(error_table({0, 5}, true, neighborhood), kContextCount);
  }
}

}  // namespace
}  // namespace limber
