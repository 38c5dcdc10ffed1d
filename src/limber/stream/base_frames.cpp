// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/base_frames.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

namespace limber {
namespace {

// Where the length is known: the i-th of `wanted` frames that include the first and the last.
std::uint32_t evenly_spread(std::uint32_t i, std::uint32_t wanted, std::uint32_t frame_count) {
  if (wanted < 2) return 0;
  return static_cast<std::uint32_t>((std::uint64_t{i} * (frame_count - 1) + (wanted - 1) / 2) / (wanted - 1));
}

}  // namespace

Result<BaseFrames> choose_base_frames(ClipReader& clip, std::uint32_t most,
                                      const std::function<bool(std::uint32_t)>& go_on) {
  assert(most >= 1);
  const std::optional<std::uint32_t> known = clip.frame_count();
  const std::uint32_t wanted = known ? std::min(most, *known) : most;
  BaseFrames chosen;
  std::vector<Vec3f> positions(clip.mesh().vertex_count);
  std::uint32_t stride = 1;
  for (std::uint32_t frame = 0;; ++frame) {
    const auto kept = static_cast<std::uint32_t>(chosen.positions.size());
    if (most == 1 && kept == 1) return chosen;
    const Result<bool> more = clip.read(positions);
    if (!more) return more.error();
    if (!*more) {
      if (frame == 0) return Error{ErrorCode::kBadInput, "", "the clip has no frames"};
      chosen.frame_count = frame;
      return chosen;
    }
    if (known) {
      if (kept < wanted && frame == evenly_spread(kept, wanted, *known)) chosen.positions.push_back(positions);
    } else if (frame % stride == 0) {
      if (kept == most) {
        for (std::uint32_t i = 1; 2 * i < kept; ++i) std::swap(chosen.positions[i], chosen.positions[2 * i]);
        chosen.positions.resize((kept + 1) / 2);
        stride *= 2;
      }
      if (frame % stride == 0) chosen.positions.push_back(positions);
    }
    if (go_on && !go_on(frame + 1)) return Error{ErrorCode::kCancelled, "", "interrupted"};
  }
}

}  // namespace limber
