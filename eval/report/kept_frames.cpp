// SPDX-License-Identifier: Apache-2.0
#include "eval/report/kept_frames.h"

#include <algorithm>
#include <cmath>

namespace limber::eval {
namespace {

std::shared_ptr<const KeptFrame> keep(std::size_t frame, std::span<const Vec3f> original,
                                      const Comparison& comparison) {
  auto kept = std::make_shared<KeptFrame>();
  kept->frame = frame;
  kept->original.assign(original.begin(), original.end());
  for (const Contender& contender : comparison.contenders())
    kept->made.push_back({contender.approximation.triangles, contender.approximation.positions});
  return kept;
}

}  // namespace

KeptFrames::KeptFrames(std::size_t frame_count) {
  constexpr std::size_t kSpread = 4;  // the fifth is the worst
  for (std::size_t k = 0; k < kSpread && frame_count > 0; ++k) {
    const double place = static_cast<double>(k * (frame_count - 1)) / (kSpread - 1);
    spread_.push_back(static_cast<std::size_t>(std::lround(place)));
  }
}

void KeptFrames::add(std::span<const Vec3f> original, const Comparison& comparison,
                     std::span<const std::size_t> worse) {
  Kept now;
  const auto kept_now = [&]() -> const Kept& {
    if (!now) now = keep(frame_, original, comparison);
    return now;
  };
  if (std::find(spread_.begin(), spread_.end(), frame_) != spread_.end()) kept_.push_back(kept_now());
  const double rms = comparison.contenders().front().measure.frames().back().distance.rms;
  if (rms > worst_rms_) worst_ = kept_now(), worst_rms_ = rms;
  worst_of_.resize(comparison.contenders().size());
  for (const std::size_t method : worse) worst_of_[method] = kept_now();
  ++frame_;
}

std::vector<KeptFrames::Kept> KeptFrames::gallery() const {
  std::vector<Kept> all = kept_;
  all.push_back(worst_);
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a->frame < b->frame; });
  all.erase(std::unique(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a->frame == b->frame; }),
            all.end());
  return all;
}

}  // namespace limber::eval
