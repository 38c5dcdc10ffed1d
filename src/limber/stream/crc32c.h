// SPDX-License-Identifier: Apache-2.0
// CRC-32C (Castagnoli), sixteen bytes at a time: finds every change of up to 32 neighbouring bits, hence of any byte.
// Part of the player.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "limber/stream/bytes.h"

namespace limber {

namespace crc32c_detail {

using Tables = std::array<std::array<std::uint32_t, 256>, 16>;

// tables[k][b]: what byte b does to the checksum when k more bytes follow it.
constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t b = 0; b < 256; ++b) {
    std::uint32_t c = b;
    for (int i = 0; i < 8; ++i) c = (c >> 1) ^ ((c & 1) ? 0x82f63b78u : 0u);
    tables[0][b] = c;
  }
  for (std::size_t k = 1; k < 16; ++k)
    for (std::size_t b = 0; b < 256; ++b) tables[k][b] = (tables[k - 1][b] >> 8) ^ tables[0][tables[k - 1][b] & 0xff];
  return tables;
}

#if defined(__wasm__)
// Made when the module starts: tables do not compress, and would be a quarter of what a browser has to load.
struct TablesMadeAtTheStart {
  TablesMadeAtTheStart() : tables(make_tables()) {}
  Tables tables;
};
inline const TablesMadeAtTheStart kMade;
inline const Tables& kTables = kMade.tables;
#else
inline constexpr Tables kTables = make_tables();
#endif

}  // namespace crc32c_detail

inline std::uint32_t crc32c(std::span<const std::byte> bytes) {
  const auto& t = crc32c_detail::kTables;
  std::uint32_t c = ~0u;
  const std::byte* p = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= 16; p += 16, left -= 16) {
    const std::uint64_t v = load_little_endian<std::uint64_t>(p) ^ c, w = load_little_endian<std::uint64_t>(p + 8);
    c = t[15][v & 0xff] ^ t[14][(v >> 8) & 0xff] ^ t[13][(v >> 16) & 0xff] ^ t[12][(v >> 24) & 0xff] ^
        t[11][(v >> 32) & 0xff] ^ t[10][(v >> 40) & 0xff] ^ t[9][(v >> 48) & 0xff] ^ t[8][v >> 56] ^ t[7][w & 0xff] ^
        t[6][(w >> 8) & 0xff] ^ t[5][(w >> 16) & 0xff] ^ t[4][(w >> 24) & 0xff] ^ t[3][(w >> 32) & 0xff] ^
        t[2][(w >> 40) & 0xff] ^ t[1][(w >> 48) & 0xff] ^ t[0][w >> 56];
  }
  for (; left > 0; ++p, --left) c = (c >> 8) ^ t[0][(c ^ std::to_integer<std::uint32_t>(*p)) & 0xff];
  return ~c;
}

}  // namespace limber
