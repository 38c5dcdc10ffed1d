// SPDX-License-Identifier: Apache-2.0
// The frames of a comparison that the report takes pictures of, kept while the comparison goes on.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "eval/comparison.h"
#include "eval/report/worst_places.h"
#include "eval/surface.h"

namespace limber::eval {

struct KeptFrame {
  std::size_t frame = 0;  // counted from 0
  std::vector<Vec3f> original{};
  struct Made {
    std::vector<Triangle> triangles{};
    std::vector<Vec3f> positions{};

    operator Surface() const { return {triangles, positions}; }
  };
  std::vector<Made> made{};  // [methods]
};

// At most a frame per method and five more are kept at a time, whatever the length of the clip.
class KeptFrames {
 public:
  explicit KeptFrames(std::size_t frame_count);

  // The frame that the comparison has just measured, and the methods that were worse in it than ever before.
  void add(std::span<const Vec3f> original, const Comparison& comparison, std::span<const std::size_t> worse);

  using Kept = std::shared_ptr<const KeptFrame>;

  // In the order of the clip: its first frame and its last, where the first method's rms is largest, and others spread
  // evenly; five at most, all different.
  std::vector<Kept> gallery() const;

  // Where the first method's rms is largest. Precondition of both: a frame has been added.
  std::size_t worst_frame() const { return worst_->frame; }
  const Kept& worst_of(std::size_t method) const { return worst_of_[method]; }

 private:
  std::size_t frame_ = 0;
  std::vector<std::size_t> spread_;  // the frames to keep anyway
  std::vector<Kept> kept_;
  Kept worst_;
  double worst_rms_ = -1;
  std::vector<Kept> worst_of_;  // [methods]
};

}  // namespace limber::eval
