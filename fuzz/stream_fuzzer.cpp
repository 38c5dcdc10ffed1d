// SPDX-License-Identifier: Apache-2.0
// Streams with any bytes. Checksums are made right first: else nothing would get past them.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "limber/stream/chunk.h"
#include "limber/stream/decoder.h"

namespace {

void put(std::byte* at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) at[i] = static_cast<std::byte>(value >> (8 * i));
}

void seal_chunks(std::span<std::byte> bytes) {
  using namespace limber;
  std::size_t at = kPreambleSize;
  while (at < bytes.size() && bytes.size() - at >= kChunkHeaderSize) {
    const std::size_t length = load_little_endian<std::uint32_t>(&bytes[at + 8]);
    const std::size_t present = bytes.size() - at - kChunkHeaderSize;
    if (length <= present) put(&bytes[at + 12], crc32c(bytes.subspan(at + kChunkHeaderSize, length)));
    put(&bytes[at + 16], crc32c(bytes.subspan(at, 16)));
    if (length > present) return;
    at += kChunkHeaderSize + length;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(input.begin(), input.end());
  seal_chunks(bytes);
  limber::Decoder decoder;
  if (!decoder.open(bytes)) return 0;
  limber::FrameState state;
  decoder.prepare(state);
  for (std::uint32_t frame = 0; frame < decoder.available_frames(); ++frame) {
    if (!decoder.is_key(frame) && state.frame != frame - 1) continue;
    if (!decoder.decode(frame, state)) continue;
    for (const limber::Vec3f& position : state.positions)
      if (!limber::is_finite(position)) std::abort();
  }
  return 0;
}
