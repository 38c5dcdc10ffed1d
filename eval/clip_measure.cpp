// SPDX-License-Identifier: Apache-2.0
#include "eval/clip_measure.h"

#include <algorithm>
#include <cassert>

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
  frame.flicker = flicker_.add(original, approximation_tree_);
  if (!ids.empty()) frame.changed = changed_.add(ids);
  return frames_.emplace_back(frame);
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
