// SPDX-License-Identifier: Apache-2.0
#include "limber/view/arriving_bytes.h"

#include <gtest/gtest.h>

#include "tests/view/patches.h"

namespace limber {
namespace {

std::vector<std::byte> numbered(std::size_t count) {
  std::vector<std::byte> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 31 + i / 256);
  return bytes;
}

TEST(ArrivingBytes, KeepTheirOrderWhileTheyAreAppended) {
  const auto whole = numbered(200'000);
  ArrivingBytes bytes;
  for (std::size_t at = 0; at < whole.size();) {
    const std::size_t size = std::min<std::size_t>(1 + at / 3, whole.size() - at);
    ASSERT_TRUE(bytes.append(std::span(whole).subspan(at, size)));
    at += size;
    ASSERT_EQ(bytes.prefix(), at);
    ASSERT_EQ(bytes.bytes().size(), at);
  }
  EXPECT_TRUE(std::equal(whole.begin(), whole.end(), bytes.bytes().begin()));
}

TEST(ArrivingBytes, ComeInAnyOrderAndOverlap) {
  const auto whole = numbered(1000);
  for (std::uint32_t seed = 1; seed < 20; ++seed) {
    test::Random random(seed);
    ArrivingBytes bytes;
    ASSERT_TRUE(bytes.append(std::span(whole).first(random.below(100))));
    ASSERT_TRUE(bytes.set_size(1000));
    std::vector<bool> is_there(1000, false);
    std::fill_n(is_there.begin(), bytes.prefix(), true);
    while (bytes.count() < 1000) {
      const std::uint32_t at = random.below(1001), size = random.below(std::min(61u, 1001 - at));
      bytes.supply(at, std::span(whole).subspan(at, size));
      std::fill_n(is_there.begin() + at, size, true);
      ASSERT_EQ(bytes.count(), static_cast<std::uint64_t>(std::count(is_there.begin(), is_there.end(), true)));
      const auto first_gap =
          static_cast<std::uint64_t>(std::find(is_there.begin(), is_there.end(), false) - is_there.begin());
      ASSERT_EQ(bytes.prefix(), first_gap);
      const Extent gap = bytes.first_missing({0, 1000});
      ASSERT_EQ(gap.begin, first_gap);
      for (std::uint64_t i = gap.begin; i < gap.end; ++i) ASSERT_FALSE(is_there[i]);
      ASSERT_TRUE(gap.end == 1000 || is_there[gap.end]);
      for (std::size_t i = 0; i < 1000; ++i) ASSERT_EQ(bytes.bytes()[i], is_there[i] ? whole[i] : std::byte{0});
    }
    EXPECT_TRUE(bytes.has({0, 1000}));
  }
}

TEST(ArrivingBytes, ThatAreThereAreNotReplaced) {
  ArrivingBytes bytes;
  ASSERT_TRUE(bytes.set_size(3));
  const std::byte one[] = {std::byte{1}}, twos[] = {std::byte{2}, std::byte{2}, std::byte{2}};
  bytes.supply(1, one);
  bytes.supply(0, twos);
  EXPECT_EQ(bytes.bytes()[1], std::byte{1});
  EXPECT_EQ(bytes.bytes()[2], std::byte{2});
}

TEST(ArrivingBytes, SayWhereThereIsNoMemory) {
  ArrivingBytes bytes;
  EXPECT_FALSE(bytes.set_size(~std::uint64_t{0}));
  EXPECT_TRUE(bytes.set_size(10));
}

}  // namespace
}  // namespace limber
