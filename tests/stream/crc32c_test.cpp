// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/crc32c.h"

#include <cstring>
#include <gtest/gtest.h>
#include <vector>

namespace limber {
namespace {

std::span<const std::byte> bytes_of(const char* text) { return std::as_bytes(std::span(text, std::strlen(text))); }

TEST(Crc32c, GivesThePublishedCheckValue) { EXPECT_EQ(crc32c(bytes_of("123456789")), 0xe3069283u); }

// RFC 3720, appendix B.4.
TEST(Crc32c, GivesThePublishedValuesOfLongerBlocks) {
  std::vector<std::byte> block(32, std::byte{0});
  EXPECT_EQ(crc32c(block), 0x8a9136aau);
  block.assign(32, std::byte{0xff});
  EXPECT_EQ(crc32c(block), 0x62a8ab43u);
  for (std::size_t i = 0; i < 32; ++i) block[i] = static_cast<std::byte>(i);
  EXPECT_EQ(crc32c(block), 0x46dd794eu);
}

TEST(Crc32c, OfNothingIsZero) { EXPECT_EQ(crc32c({}), 0u); }

}  // namespace
}  // namespace limber
