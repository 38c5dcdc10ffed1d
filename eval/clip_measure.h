// SPDX-License-Identifier: Apache-2.0
// All measures of a clip, frame by frame.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "eval/changed.h"
#include "eval/closest_point.h"
#include "eval/distance.h"
#include "eval/flicker.h"
#include "eval/quality.h"
#include "eval/surface.h"

namespace limber::eval {

struct ClipMeasureOptions {
  DistanceOptions distance{};            // its samples serve flicker too
  std::uint32_t first_frame_number = 0;  // as the clip numbers its frames
};

struct FrameMeasure {
  std::uint32_t number = 0;  // of the frame
  Distance distance;
  Quality quality;
  std::optional<double> flicker;  // change of the error since the frame before; nothing in the first frame
  std::optional<double> changed;  // nothing in the first frame and where the caller has no ids
};

// A measure over the frames that have it.
struct Statistic {
  double mean = 0;
  double percentile_95 = 0;
  double worst = 0;
};

// 95th percentile: the smallest value that at least 95 of 100 do not exceed. Nothing for no values.
std::optional<Statistic> statistic(std::vector<double> values);

// What the distances of a clip rest on: the least over the frames, and the worst.
struct Confidence {
  std::size_t original_samples = 0;       // in a frame, on the original ...
  std::size_t approximation_samples = 0;  // ... and on the approximation
  double rms_within = 0;  // in 95 of 100 runs with other seeds, rms is no farther than so from its true value
};

struct ClipSummary {
  Statistic rms, mean, max;          // of the surface distance
  std::optional<Statistic> flicker;  // its mean is the flicker of the clip
  std::optional<Statistic> changed;
  Statistic triangle_count;
  Statistic inverted;  // triangles per frame
};

// Takes a clip frame by frame; keeps a few hundred bytes per frame, and the first frame's surfaces until the second.
class ClipMeasure {
 public:
  explicit ClipMeasure(const ClipMeasureOptions& options = {})
      : options_(options), flicker_(options.distance.samples) {}

  // Measures the next frame. `ids` names the corners of the approximation's triangles by node ids that mean the same in
  // every frame ([approximation.triangles.size()], or empty where there are none: then nothing is said about changed
  // triangles). Preconditions: the original has the same triangles in every frame; both surfaces have a triangle; the
  // original's bounding box is not a point.
  const FrameMeasure& add(const Surface& original, const Surface& approximation, std::span<const Triangle> ids);

  const ClipMeasureOptions& options() const { return options_; }
  std::span<const FrameMeasure> frames() const { return frames_; }

  // All zero before the first frame, both.
  ClipSummary summary() const;
  Confidence confidence() const;

 private:
  struct Kept {
    std::vector<Triangle> triangles;
    std::vector<Vec3f> positions;

    operator Surface() const { return {triangles, positions}; }
  };

  std::optional<double> flicker(const Surface& original, const Surface& approximation);

  ClipMeasureOptions options_;
  ClosestPointTree original_tree_;
  ClosestPointTree approximation_tree_;
  Flicker flicker_;
  Kept first_original_, first_approximation_;  // where frames_ has one element
  ChangedTriangles changed_;
  std::vector<FrameMeasure> frames_;
};

}  // namespace limber::eval
