// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "limber/stream/chunk.h"

namespace limber {

// Makes the checksums of all whole chunks right.
inline void seal_chunks(std::span<std::byte> bytes) {
  const auto put = [&bytes](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::byte>(value >> (8 * i));
  };
  std::size_t at = kPreambleSize;
  while (at < bytes.size() && bytes.size() - at >= kChunkHeaderSize) {
    const std::size_t length = load_little_endian<std::uint32_t>(&bytes[at + 8]);
    const std::size_t present = bytes.size() - at - kChunkHeaderSize;
    if (length <= present) put(at + 12, crc32c(bytes.subspan(at + kChunkHeaderSize, length)));
    put(at + 16, crc32c(bytes.subspan(at, 16)));
    if (length > present) return;
    at += kChunkHeaderSize + length;
  }
}

}  // namespace limber
