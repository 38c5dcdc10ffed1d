// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/residuals.h"

#include <gtest/gtest.h>
#include <random>

namespace limber {
namespace {

TEST(Residuals, EveryMagnitudeBelongsToTheClassThatHoldsIt) {
  for (std::uint32_t magnitude = 0; magnitude < 5000; ++magnitude) {
    const int c = class_of(magnitude);
    ASSERT_GE(magnitude, kClasses[static_cast<std::size_t>(c)].first);
    if (c < kEscapeClass) {
      ASSERT_LT(magnitude, kClasses[static_cast<std::size_t>(c) + 1].first);
    }
  }
  EXPECT_EQ(class_of(0x80000000u), kEscapeClass);
}

TEST(Residuals, FrequenciesFillTheTableAndNoneIsZero) {
  ResidualStatistics statistics;
  for (int i = 0; i < 100000; ++i) statistics.count(3, 5);
  statistics.update();
  for (int t = 0; t < kContextCount; ++t) {
    std::uint32_t sum = 0;
    for (const std::uint16_t frequency : statistics.table(t).frequency) {
      EXPECT_GE(frequency, 1u);
      sum += frequency;
    }
    EXPECT_EQ(sum, 1u << kFrequencyBits);
  }
}

// Magnitudes of every size under expectations of every size, over three frames so that the tables move.
TEST(Residuals, ComeBackFromTheirBytes) {
  std::mt19937 random(11);
  ResidualStatistics writing, reading;
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<std::pair<Activity, Lattice>> all;
    for (int i = 0; i < 2000; ++i) {
      std::pair<Activity, Lattice> one;
      for (std::size_t k = 0; k < 3; ++k) {
        one.first[k] = static_cast<std::uint32_t>(random()) >> (2 + random() % 30);
        one.second[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(random()) >> (random() % 32));
        if (random() % 2) one.second[k] = -one.second[k];
      }
      all.push_back(one);
    }
    all[5].second = {INT32_MIN, INT32_MAX, 0};
    ResidualWriter writer(writing);
    for (const auto& [activity, residuals] : all) writer.code(activity, residuals);
    const auto bytes = writer.finish();
    writing.update();
    ResidualReader reader(bytes, reading);
    for (const auto& [activity, residuals] : all) ASSERT_EQ(reader.code(activity), residuals);
    EXPECT_TRUE(reader.consistent());
    reading.update();
  }
}

TEST(Residuals, ReadAnythingFromGarbageAndSaySo) {
  std::mt19937 random(5);
  for (std::size_t size = 0; size < 100; ++size) {
    std::vector<std::byte> garbage(size);
    for (std::byte& byte : garbage) byte = static_cast<std::byte>(random());
    ResidualStatistics statistics;
    ResidualReader reader(garbage, statistics);
    for (int i = 0; i < 200; ++i) reader.code({static_cast<std::uint32_t>(random()) >> 1, 0, 5});
    EXPECT_FALSE(reader.consistent());
  }
}

}  // namespace
}  // namespace limber
