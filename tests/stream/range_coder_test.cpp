// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/range_coder.h"

#include <gtest/gtest.h>
#include <random>

namespace limber {
namespace {

TEST(RangeCoder, ReturnsNumbersOfEverySize) {
  const std::vector<std::uint32_t> numbers{0, 1, 2, 3, 4, 255, 256, 65535, 65536, 0x7fffffff, 0xfffffffe, 0, 7};
  RangeEncoder encoder;
  NumberModel writing;
  for (const std::uint32_t number : numbers) writing.code(encoder, number);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  NumberModel reading;
  for (const std::uint32_t number : numbers) EXPECT_EQ(reading.code(decoder), number);
}

TEST(RangeCoder, ReturnsDifferencesOfBothSigns) {
  const std::vector<std::int32_t> differences{0, 1, -1, 2, -2, 1000, -1000, 0x7fffffff, -0x7fffffff, INT32_MIN};
  RangeEncoder encoder;
  DifferenceModel writing;
  for (const std::int32_t difference : differences) writing.code(encoder, difference);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  DifferenceModel reading;
  for (const std::int32_t difference : differences) EXPECT_EQ(reading.code(decoder), difference);
}

TEST(RangeCoder, CarriesThroughLongRunsOfFullBytes) {
  // Bits against the expectation of the model push the low end up by almost the whole range.
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::vector<std::pair<unsigned, std::uint32_t>> plain;
    std::vector<unsigned> bits;
    RangeEncoder encoder;
    BitModel writing;
    for (int i = 0; i < 300; ++i) {
      bits.push_back(random() % 64 != 0 || i % 100 > 90 ? 1 : 0);
      encoder.bit(writing, bits.back());
      const auto count = static_cast<unsigned>(random() % 17);
      plain.emplace_back(count, count == 0 ? 0 : (1u << count) - 1 - (random() % 3 == 0 ? 1u : 0u));
      encoder.plain(plain.back().first, plain.back().second);
    }
    const auto bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    BitModel reading;
    for (std::size_t i = 0; i < bits.size(); ++i) {
      ASSERT_EQ(decoder.bit(reading), bits[i]) << "seed " << seed;
      ASSERT_EQ(decoder.plain(plain[i].first), plain[i].second) << "seed " << seed;
    }
  }
}

TEST(RangeCoder, SpendsLittleOnWhatIsAlwaysTheSame) {
  RangeEncoder encoder;
  BitModel model;
  for (int i = 0; i < 10000; ++i) encoder.bit(model, 1);
  EXPECT_LT(encoder.finish().size(), 20u);
}

TEST(RangeCoder, ReadsAnythingPastTheEndAndFromGarbage) {
  std::mt19937 random(3);
  std::vector<std::byte> garbage(50);
  for (std::byte& byte : garbage) byte = static_cast<std::byte>(random());
  RangeDecoder decoder(garbage);
  NumberModel model;
  for (int i = 0; i < 1000; ++i) {
    model.code(decoder);
    EXPECT_LT(decoder.plain(10), 1024u);
  }
}

}  // namespace
}  // namespace limber
