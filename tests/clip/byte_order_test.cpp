// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/byte_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string_view>

namespace limber {
namespace {

TEST(ByteOrder, LittleEndianHasTheLowestByteFirst) {
  const char bytes[] = {'\x01', '\x02', '\x03', '\xff'};
  EXPECT_EQ((load<std::uint32_t, std::endian::little>(bytes)), 0xff030201u);
  EXPECT_EQ((load<std::uint32_t, std::endian::big>(bytes)), 0x010203ffu);
  EXPECT_EQ((load<std::uint16_t, std::endian::big>(bytes)), 0x0102u);
}

TEST(ByteOrder, StoreIsTheInverseOfLoad) {
  char bytes[8];
  store<std::uint64_t, std::endian::big>(0x0123456789abcdefu, bytes);
  EXPECT_EQ(bytes[0], '\x01');
  EXPECT_EQ((load<std::uint64_t, std::endian::big>(bytes)), 0x0123456789abcdefu);
  store_float<std::endian::little>(1.0f, bytes);
  EXPECT_EQ(std::string_view(bytes, 4), std::string_view("\x00\x00\x80\x3f", 4));
  EXPECT_EQ(load_float<std::endian::little>(bytes), 1.0f);
}

}  // namespace
}  // namespace limber
