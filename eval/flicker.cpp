// SPDX-License-Identifier: Apache-2.0
//   add(original, approximation):
//     for each sample: s = normal . (closest point - sample); difference to the s of the frame before; remember s
#include "eval/flicker.h"

#include <array>
#include <cassert>
#include <cmath>

#include "eval/sum_pieces.h"

namespace limber::eval {
namespace {

struct Sums {
  double squared = 0;
  std::size_t count = 0;

  Sums& operator+=(const Sums& other) {
    squared += other.squared, count += other.count;
    return *this;
  }
};

}  // namespace

std::optional<double> Flicker::add(const Surface& original, const ClosestPointTree& approximation) {
  assert(!original.triangles.empty() && approximation.triangle_count() > 0);
  const bool first_frame = !samples_;
  if (first_frame) {
    const double diagonal = bounding_box(original).diagonal();
    assert(diagonal > 0);
    percent_ = 100 / diagonal;
    samples_.emplace(original, options_.total(original.triangles.size()), options_.seed);
    distances_.assign(samples_->size(), std::nan(""));
  }
  const Sums sums = sum_pieces<Sums>(samples_->size(), [&](std::size_t first, std::size_t count) {
    std::array<SurfaceSample, kPiece> buffer;
    const std::span<SurfaceSample> samples(buffer.data(), count);
    samples_->fill(first, samples);
    Sums part;
    Index hint = kNone;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3d p = point_at(original, samples[i].triangle, samples[i].barycentric);
      const ClosestPoint closest = approximation.closest(p, hint);
      hint = closest.triangle;
      const Vec3d normal = area_vector(original, samples[i].triangle);
      const double s = dot(normal, closest.point - p) / length(normal);  // 0/0 where the triangle has no normal
      const double change = s - distances_[first + i];
      distances_[first + i] = s;
      if (std::isfinite(change)) part.squared += change * change, ++part.count;
    }
    return part;
  });
  if (first_frame) return std::nullopt;
  const double change = sums.count > 0 ? std::sqrt(sums.squared / static_cast<double>(sums.count)) * percent_ : 0;
  sum_ += change;
  ++change_count_;
  return change;
}

std::optional<double> Flicker::value() const {
  if (change_count_ == 0) return std::nullopt;
  return sum_ / change_count_;
}

}  // namespace limber::eval
