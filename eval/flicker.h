// SPDX-License-Identifier: Apache-2.0
// How much the error of an approximation moves from frame to frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "eval/closest_point.h"
#include "eval/sample_surface.h"
#include "eval/surface.h"

namespace limber::eval {

// Takes a clip frame by frame. Samples are fixed on the original surface, uniform by area in the first frame, with the
// same barycentric coordinates in all frames. At each, s_t is the part along the original's normal of the way to the
// closest point of the approximation at frame t. The change of a frame is the root mean square over the samples of
// s_t - s_{t-1}; flicker is the mean of the changes; both in percent of the diagonal of the first frame's bounding
// box. An approximation that is wrong in the same way all the time has none. Keeps one number per sample.
class Flicker {
 public:
  explicit Flicker(const SampleOptions& options = {}) : options_(options) {}

  // Gives the change since the frame before; nothing for the first frame. A sample whose triangle has no normal, in
  // this frame or the one before, is left out. Preconditions: `original` has the same triangles in every frame, at
  // least one, and in the first frame an extent; the approximation has a triangle.
  std::optional<double> add(const Surface& original, const ClosestPointTree& approximation);

  // The mean of the changes so far; nothing before the second frame.
  std::optional<double> value() const;

 private:
  SampleOptions options_;
  std::optional<AreaSamples> samples_;
  std::vector<double> distances_;  // s of the last frame, [samples_->size()]; not a number where undefined
  double percent_ = 0;
  double sum_ = 0;
  std::uint32_t change_count_ = 0;
};

}  // namespace limber::eval
