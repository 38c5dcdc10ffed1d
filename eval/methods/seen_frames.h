// SPDX-License-Identifier: Apache-2.0
// The frames that methods look at before they begin.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "eval/methods/method.h"
#include "limber/base/result.h"
#include "limber/clip/clip.h"
#include "limber/stream/base_frames.h"

namespace limber::eval {

class SeenFrames {
 public:
  // Reads what the methods want to see, and rewinds the clip. `base_count`: how many Sees::kBase has, >= 1.
  // `go_on(frames read)` is called after each frame; false: stop. Errors: as choose_base_frames().
  static Result<SeenFrames> read(ClipReader& clip, std::span<const MethodInfo* const> methods, std::uint32_t base_count,
                                 const std::function<bool(std::uint32_t)>& go_on);

  // At least one, the first of them the first frame of the clip. Precondition: the method was among those read for.
  std::vector<std::span<const Vec3f>> of(const MethodInfo& method) const;

 private:
  BaseFrames base_, many_;
};

// How many frames Sees::kMany is at most: quadrics and positions of so many take a quarter of a gigabyte.
std::uint32_t many_frames(Index vertex_count);

}  // namespace limber::eval
