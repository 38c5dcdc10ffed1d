// SPDX-License-Identifier: Apache-2.0
#include "eval/report/parts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace limber::eval {
namespace {

constexpr std::size_t kSamples = 2000;  // on a part

Vec3d middle(const Surface& surface, std::size_t t) {
  return (corner(surface, t, 0) + corner(surface, t, 1) + corner(surface, t, 2)) * (1.0 / 3);
}

}  // namespace

Parts::Parts(std::vector<PartBall> balls, std::size_t method_count, std::uint64_t seed)
    : balls_(std::move(balls)),
      seed_(seed),
      triangles_(balls_.size()),
      samples_(balls_.size()),
      sums_(balls_.size(), std::vector<PartMeasure>(method_count)) {
  assert(method_count > 0);
}

Result<void> Parts::find(const Surface& original) {
  for (std::size_t part = 0; part < balls_.size(); ++part) {
    const PartBall& ball = balls_[part];
    std::vector<Triangle> found;
    for (Index t = 0; t < original.triangles.size(); ++t) {
      if (length(middle(original, t) - ball.center) > ball.radius) continue;
      triangles_[part].push_back(t);
      found.push_back(original.triangles[t]);
    }
    if (found.empty())
      return Error{ErrorCode::kBadInput, fmt::format("part {}", ball.name), "the first frame has no triangle there"};
    const AreaSamples area({found, original.positions}, kSamples, seed_);
    samples_[part].resize(area.size());
    area.fill(0, samples_[part]);
    for (SurfaceSample& sample : samples_[part]) sample.triangle = triangles_[part][sample.triangle];
  }
  return {};
}

void Parts::count_triangles(const Surface& approximation, std::size_t method) {
  points_.resize(approximation.triangles.size());
  closest_.resize(points_.size());
  for (std::size_t t = 0; t < points_.size(); ++t) points_[t] = middle(approximation, t);
  original_tree_.closest(points_, closest_);
  for (std::size_t part = 0; part < balls_.size(); ++part) {
    const std::vector<Index>& own = triangles_[part];
    const auto count = std::ranges::count_if(
        closest_, [&](const ClosestPoint& closest) { return std::ranges::binary_search(own, closest.triangle); });
    sums_[part][method].last_triangles = static_cast<double>(count);
    sums_[part][method].triangles += static_cast<double>(count);
  }
}

Result<void> Parts::add(const Surface& original, std::span<const Surface> approximations) {
  if (balls_.empty()) return {};
  assert(approximations.size() == sums_.front().size());
  if (frame_count_ == 0) {
    if (Result<void> found = find(original); !found) return found;
  }
  original_tree_.rebuild(original);
  const double diagonal = bounding_box(original).diagonal();
  for (std::size_t method = 0; method < approximations.size(); ++method) {
    count_triangles(approximations[method], method);
    approximation_tree_.rebuild(approximations[method]);
    for (std::size_t part = 0; part < balls_.size(); ++part) {
      const std::vector<SurfaceSample>& samples = samples_[part];
      points_.resize(samples.size());
      closest_.resize(samples.size());
      for (std::size_t i = 0; i < samples.size(); ++i)
        points_[i] = point_at(original, samples[i].triangle, samples[i].barycentric);
      approximation_tree_.closest(points_, closest_);
      double sum = 0;
      for (const ClosestPoint& closest : closest_) sum += closest.squared_distance;
      sums_[part][method].rms += 100 * std::sqrt(sum / static_cast<double>(samples.size())) / diagonal;
    }
  }
  ++frame_count_;
  return {};
}

PartMeasure Parts::measure(std::size_t part, std::size_t method) const {
  assert(frame_count_ > 0);
  const PartMeasure& sums = sums_[part][method];
  const auto frames = static_cast<double>(frame_count_);
  return {sums.triangles / frames, sums.last_triangles, sums.rms / frames};
}

}  // namespace limber::eval
