// SPDX-License-Identifier: Apache-2.0
#include "eval/comparison.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <limits>

#include "eval/methods/thread_time.h"

namespace limber::eval {
namespace {

double ratio(double value, double first) {
  if (first > 0) return value / first;
  return value > 0 ? std::numeric_limits<double>::infinity() : 1.0;
}

double mean_adapt_seconds(std::span<const MethodFrame> frames) {
  double sum = 0;
  for (const MethodFrame& frame : frames) sum += frame.adapt_seconds;
  return frames.empty() ? 0.0 : sum / static_cast<double>(frames.size());
}

}  // namespace

std::optional<Statistic> quadric_errors(const Contender& contender) {
  std::vector<double> values;
  for (const MethodFrame& frame : contender.frames) {
    if (frame.quadric_error) values.push_back(*frame.quadric_error);
  }
  return statistic(std::move(values));
}

double rms_ratio(const FrameMeasure& frame, const FrameMeasure& first) {
  return ratio(frame.distance.rms, first.distance.rms);
}

Comparison::Comparison(std::span<const MethodInfo* const> methods, const MethodOptions& options,
                       const ClipMeasureOptions& measure)
    : options_(options), first_frame_number_(measure.first_frame_number) {
  assert(!methods.empty());
  for (const MethodInfo* info : methods) {
    Contender& contender = contenders_.emplace_back();
    contender.info = info;
    contender.method = info->create(options);
    contender.measure = ClipMeasure(measure);
  }
}

void Comparison::begin(const Mesh& mesh, const SeenFrames& seen) {
  mesh_ = &mesh;
  quadric_error_.emplace(mesh, options_.contract.quadrics);
  for (Contender& contender : contenders_) {
    const auto frames = seen.of(*contender.info);
    const ThreadTimer timer;
    contender.method->begin(mesh, frames);
    contender.begin_seconds = timer.seconds();
  }
}

Result<void> Comparison::add(std::span<const Vec3f> positions) {
  assert(mesh_ != nullptr);
  const Surface original{mesh_->triangles, positions};
  const auto number = first_frame_number_ + contenders_.front().frames.size();
  if (!(bounding_box(original).diagonal() > 0)) {
    return Error{ErrorCode::kBadInput, fmt::format("frame {}", number),
                 "all of its triangles lie in one point: there is nothing to measure against"};
  }
  for (Contender& contender : contenders_) {
    Approximation& made = contender.approximation;
    contender.method->frame(positions, made);
    if (made.triangles.empty()) {
      return Error{ErrorCode::kBadInput, fmt::format("frame {}", number),
                   fmt::format("method {} leaves no triangle at this size; ask for more", contender.info->name)};
    }
  }
  for (Contender& contender : contenders_) {
    const Approximation& made = contender.approximation;
    name_corners(made, ids_);
    contender.measure.add(original, {made.triangles, made.positions}, ids_);
    std::optional<double> quadric_error;
    if (!made.clusters.empty()) quadric_error = quadric_error_->measure(positions, made.clusters);
    contender.frames.push_back({.vertex_count = static_cast<Index>(made.positions.size()),
                                .quadric_error = quadric_error,
                                .adapt_seconds = made.adapt_seconds,
                                .extract_seconds = made.extract_seconds,
                                .choice_bytes = made.choice_bytes});
  }
  return {};
}

Relative Comparison::relative(std::size_t contender) const {
  const Contender& first = contenders_.front();
  const Contender& other = contenders_[contender];
  assert(!first.frames.empty());
  Relative result{.rms_by_frame = 0, .rms_worst = 0};
  for (std::size_t t = 0; t < first.frames.size(); ++t) {
    const double r = rms_ratio(other.measure.frames()[t], first.measure.frames()[t]);
    result.rms_by_frame += r / static_cast<double>(first.frames.size());
    result.rms_worst = std::max(result.rms_worst, r);
  }
  result.rms_by_mean = ratio(other.measure.summary().rms.mean, first.measure.summary().rms.mean);
  result.quadric_error = std::nullopt;
  const std::optional<Statistic> its = quadric_errors(other), firsts = quadric_errors(first);
  if (its && firsts) result.quadric_error = ratio(its->mean, firsts->mean);
  result.adapt_time = ratio(mean_adapt_seconds(other.frames), mean_adapt_seconds(first.frames));
  return result;
}

}  // namespace limber::eval
