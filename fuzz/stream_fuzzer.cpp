// SPDX-License-Identifier: Apache-2.0
// Streams with any bytes. Checksums are made right first: else nothing would get past them. Every frame that is decoded
// must be a tree of finite positions; entered at a key frame it must be the same.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "fuzz/seal_chunks.h"
#include "limber/stream/decoder.h"

namespace {

void require_tree(const limber::FrameState& state) {
  const limber::Hierarchy& h = state.hierarchy;
  for (limber::Index level = 0; level < h.level_count(); ++level) {
    for (limber::Index node = h.level_begin[level]; node < h.level_begin[level + 1]; ++node) {
      const limber::Index parent = h.parent[node];
      const bool is_top = level + 1 == h.level_count();
      if (is_top ? parent != limber::kNone : parent < h.level_begin[level + 1] || parent >= h.level_begin[level + 2])
        std::abort();
      if (!limber::is_finite(state.positions[node]) || !(state.errors[node] >= 0)) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = std::as_bytes(std::span(data, size));
  std::vector<std::byte> bytes(input.begin(), input.end());
  limber::seal_chunks(bytes);
  limber::Decoder decoder;
  if (!decoder.open(bytes)) return 0;
  limber::FrameState state, entered;
  decoder.prepare(state);
  for (std::uint32_t frame = 0; frame < decoder.available_frames(); ++frame) {
    if (!decoder.is_key(frame) && state.frame != frame - 1) continue;
    if (decoder.decode(frame, state)) require_tree(state);
  }
  const std::uint32_t last = decoder.available_frames() - 1;
  if (decoder.available_frames() == 0 || state.frame != last) return 0;
  decoder.prepare(entered);
  for (std::uint32_t frame = decoder.key_at_or_before(last); frame <= last; ++frame) {
    if (!decoder.decode(frame, entered)) return 0;
  }
  if (!(entered.hierarchy == state.hierarchy) || entered.positions != state.positions) std::abort();
  return 0;
}
