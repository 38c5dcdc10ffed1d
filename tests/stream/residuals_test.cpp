// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/residuals.h"

#include <bit>
#include <gtest/gtest.h>
#include <random>

namespace limber {
namespace {

TEST(Residuals, EveryMagnitudeBelongsToTheClassThatHoldsIt) {
  for (std::uint32_t magnitude = 0; magnitude < 5000; ++magnitude) {
    const unsigned c = class_of(magnitude);
    ASSERT_GE(magnitude, kClasses[c].first);
    if (c < kEscapeClass) {
      ASSERT_LT(magnitude, kClasses[c + 1].first);
    }
  }
  EXPECT_EQ(class_of(0x80000000u), kEscapeClass);
}

TEST(Residuals, FrequenciesFillTheTableAndNoneIsZero) {
  ResidualStatistics statistics;
  statistics.share(3, 5).count += 100000;
  statistics.update();
  for (unsigned t = 0; t < kContextCount; ++t) {
    std::uint32_t slot = 0;
    for (unsigned c = 0; c < kClassCount; ++c) {
      const auto share = statistics.share(t, c);
      EXPECT_GE(share.frequency, 1u);
      EXPECT_EQ(share.start, slot);
      for (std::uint32_t i = 0; i < share.frequency; ++i) EXPECT_EQ(statistics.class_at(t, slot++), c);
    }
    EXPECT_EQ(slot, 1u << kFrequencyBits);
  }
  EXPECT_GT(statistics.share(3, 5).frequency, (1u << kFrequencyBits) - 2 * kClassCount);
}

TEST(Residuals, ContextsGrowByHalfOctaves) {
  unsigned last_level = 0;
  for (std::uint32_t activity = 0; activity < 100000; ++activity) {
    const auto octave = static_cast<unsigned>(std::bit_width(activity + 1)) - 1;
    const unsigned level = octave == 0 ? 0 : 2 * octave + ((activity + 1) >> (octave - 1) & 1);
    const ResidualContext context = residual_context(activity);
    ASSERT_EQ(context.table, level < 16 ? level : 14 + (level & 1)) << activity;
    ASSERT_EQ(context.shift, level < 12 ? 0 : (level - 10) / 2) << activity;
    ASSERT_EQ(activity < kShiftedActivity, context.shift == 0) << activity;
    ASSERT_LE(level - last_level, 2u);
    last_level = level;
  }
  EXPECT_LE(kClasses[kEscapeClass - 1].bits + residual_context(kActivityEnd - 1).shift, 32u);
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
        one.first[k] = static_cast<std::uint32_t>(random()) >> (6 + random() % 26);
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
    for (int i = 0; i < 200; ++i) reader.code({static_cast<std::uint32_t>(random()) >> (6 + random() % 26), 0, 5});
    EXPECT_FALSE(reader.consistent());
  }
}

}  // namespace
}  // namespace limber
