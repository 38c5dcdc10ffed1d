// SPDX-License-Identifier: Apache-2.0
// The frames of a clip that a hierarchy is first made for.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/clip/clip.h"

namespace limber {

struct BaseFrames {
  std::vector<std::vector<Vec3f>>
      positions;                  // [frames chosen][vertex_count], in the order of the clip; the first is frame 0
  std::uint32_t frame_count = 0;  // of the clip, where it was read to its end; otherwise 0
};

// Chooses 1 to `most` frames, spread evenly over the clip, and never holds more than so many. Where the clip does not
// know its length: of every 2^k-th frame those that fit. `go_on(frames read)` is called after each frame; false: stop.
// Precondition: the reader is before frame 0, most >= 1. Errors: those of the reader; kBadInput for a clip without
// frames; kCancelled.
Result<BaseFrames> choose_base_frames(ClipReader& clip, std::uint32_t most,
                                      const std::function<bool(std::uint32_t)>& go_on);

}  // namespace limber
