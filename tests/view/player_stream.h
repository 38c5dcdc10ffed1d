// SPDX-License-Identifier: Apache-2.0
// A stream with many swaps, for the tests of what plays it.
#pragma once

#include <gtest/gtest.h>
#include <vector>

#include "limber/stream/encoder.h"
#include "tests/view/patches.h"

namespace limber::test {

using Bytes = std::vector<std::byte>;

inline constexpr std::uint32_t kFrameCount = 23;
inline constexpr std::uint32_t kKeyInterval = 6;

// A sheet that waves, and whose clusters change; keys at 0, 6, 12, 18.
inline Bytes make_stream() {
  const Surface s = sheet(12, 13);
  FrameState state = patch_state(s, {156, 30, 8});
  Random random(9);
  Bytes bytes;
  Encoder encoder([&](std::span<const std::byte> more) -> Result<void> {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return {};
  });
  EXPECT_TRUE(encoder.begin(s.mesh, state.hierarchy, s.positions,
                            {.key_interval = kKeyInterval, .frame_count = kFrameCount, .manifold_kept = false}));
  for (std::uint32_t frame = 0; frame < kFrameCount; ++frame) {
    std::vector<Swap> net_swaps;
    if (frame > 0) {
      const std::vector<Index> before = state.hierarchy.parent;
      deform(s.mesh, state, 12, random);
      for (Index n = 0; n < before.size(); ++n) {
        if (before[n] != state.hierarchy.parent[n]) net_swaps.push_back({n, state.hierarchy.parent[n]});
      }
      for (Index v = 0; v < s.mesh.vertex_count; ++v) state.positions[v].z += 0.1f * random.unit();
      place_nodes(s.mesh, state);
    }
    EXPECT_TRUE(encoder.add(state.hierarchy, net_swaps, state.positions, state.errors));
  }
  EXPECT_TRUE(encoder.finish());
  return bytes;
}

}  // namespace limber::test
