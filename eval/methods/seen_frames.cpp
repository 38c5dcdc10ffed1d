// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/seen_frames.h"

#include <algorithm>
#include <cassert>

#include "limber/base/quadric.h"

namespace limber::eval {

Result<SeenFrames> SeenFrames::read(ClipReader& clip, std::span<const MethodInfo* const> methods,
                                    std::uint32_t base_count, const std::function<bool(std::uint32_t)>& go_on) {
  const auto wanted = [methods](Sees sees) {
    return std::ranges::any_of(methods, [sees](const MethodInfo* info) { return info->sees == sees; });
  };
  SeenFrames seen;
  const auto read = [&](BaseFrames& into, std::uint32_t most) -> Result<void> {
    Result<BaseFrames> chosen = choose_base_frames(clip, most, go_on);
    if (!chosen) return chosen.error();
    into = std::move(*chosen);
    return clip.rewind();
  };
  if (Result<void> done = read(seen.base_, wanted(Sees::kBase) ? base_count : 1); !done) return done.error();
  if (wanted(Sees::kMany)) {
    if (Result<void> done = read(seen.many_, many_frames(clip.mesh().vertex_count)); !done) return done.error();
  }
  return seen;
}

std::vector<std::span<const Vec3f>> SeenFrames::of(const MethodInfo& method) const {
  const auto& frames = method.sees == Sees::kMany ? many_.positions : base_.positions;
  assert(!frames.empty());
  return {frames.begin(), method.sees == Sees::kFirst ? frames.begin() + 1 : frames.end()};
}

std::uint32_t many_frames(Index vertex_count) {
  constexpr std::uint64_t kMemory = std::uint64_t{1} << 28;
  const std::uint64_t per_frame = std::uint64_t{vertex_count} * (sizeof(Quadric) + 2 * sizeof(Vec3f));
  return static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(kMemory / std::max<std::uint64_t>(1, per_frame), 2, 1024));
}

}  // namespace limber::eval
