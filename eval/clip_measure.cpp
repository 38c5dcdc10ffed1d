// SPDX-License-Identifier: Apache-2.0
#include "eval/clip_measure.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace limber::eval {

std::optional<Statistic> statistic(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  const std::size_t rank = (values.size() * 95 + 99) / 100;
  return Statistic{
      .mean = sum / static_cast<double>(values.size()), .percentile_95 = values[rank - 1], .worst = values.back()};
}

namespace {

// `value(frame)` gives something that has a number, or does not.
template <class Value>
std::optional<Statistic> over_frames(std::span<const FrameMeasure> frames, const Value& value) {
  std::vector<double> values;
  for (const FrameMeasure& frame : frames) {
    if (const std::optional<double> v = value(frame)) values.push_back(*v);
  }
  return statistic(std::move(values));
}

}  // namespace

const FrameMeasure& ClipMeasure::add(const Surface& original, const Surface& approximation,
                                     std::span<const Triangle> ids) {
  assert(ids.empty() || ids.size() == approximation.triangles.size());
  original_tree_.rebuild(original);
  approximation_tree_.rebuild(approximation);

  FrameMeasure frame;
  frame.number = options_.first_frame_number + static_cast<std::uint32_t>(frames_.size());
  frame.distance = measure_distance(original, original_tree_, approximation, approximation_tree_, options_.distance);
  frame.quality = measure_quality(original, original_tree_, approximation);
  frame.flicker = flicker(original, approximation);
  if (!ids.empty()) frame.changed = changed_.add(ids);
  return frames_.emplace_back(frame);
}

// Half of the time of a single pair of meshes would go into the first frame's part in a flicker that it has not, so
// that this part waits for the second frame.
std::optional<double> ClipMeasure::flicker(const Surface& original, const Surface& approximation) {
  const auto keep = [](const Surface& surface) {
    return Kept{{surface.triangles.begin(), surface.triangles.end()},
                {surface.positions.begin(), surface.positions.end()}};
  };
  if (frames_.empty()) {
    first_original_ = keep(original);
    first_approximation_ = keep(approximation);
    return std::nullopt;
  }
  if (frames_.size() == 1) {
    flicker_.add(first_original_, ClosestPointTree(first_approximation_));
    first_original_ = first_approximation_ = {};
  }
  return flicker_.add(original, approximation_tree_);
}

Confidence ClipMeasure::confidence() const {
  constexpr double k95 = 1.96;  // standard errors
  if (frames_.empty()) return {};
  constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
  Confidence confidence{.original_samples = kMost, .approximation_samples = kMost};
  for (const FrameMeasure& frame : frames_) {
    const Distance& distance = frame.distance;
    confidence.original_samples = std::min(confidence.original_samples, distance.to_approximation.sample_count);
    confidence.approximation_samples = std::min(confidence.approximation_samples, distance.to_original.sample_count);
    confidence.rms_within = std::max(confidence.rms_within, k95 * distance.rms_error);
  }
  return confidence;
}

ClipSummary ClipMeasure::summary() const {
  const auto always = [&](auto value) {
    return over_frames(frames_, [&](const FrameMeasure& f) { return std::optional<double>(value(f)); })
        .value_or(Statistic{});
  };
  return {.rms = always([](const FrameMeasure& f) { return f.distance.rms; }),
          .mean = always([](const FrameMeasure& f) { return f.distance.mean; }),
          .max = always([](const FrameMeasure& f) { return f.distance.max; }),
          .flicker = over_frames(frames_, [](const FrameMeasure& f) { return f.flicker; }),
          .changed = over_frames(frames_, [](const FrameMeasure& f) { return f.changed; }),
          .triangle_count = always([](const FrameMeasure& f) { return static_cast<double>(f.quality.triangle_count); }),
          .inverted = always([](const FrameMeasure& f) { return static_cast<double>(f.quality.inverted); })};
}

}  // namespace limber::eval
