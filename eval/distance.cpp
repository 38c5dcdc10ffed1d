// SPDX-License-Identifier: Apache-2.0
// For each direction, from surface A to surface B:
//
//   samples on A, in pieces of fixed size, in parallel:
//     d = distance to B's closest point; sums of d, d^2, d^4 and of the squared differences of successive d^2
//   add the pieces up in order; max also over A's vertices
//
// Successive samples lie in the same triangle or in neighbouring ones of the list, so their differences show how much
// of the variance stratification has left (Wolter, Introduction to Variance Estimation, on systematic samples).
#include "eval/distance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "eval/sum_pieces.h"

namespace limber::eval {
namespace {

struct Sums {
  double distance = 0;
  double squared = 0;
  double difference = 0;  // of successive squared distances, squared
  double largest_squared = 0;

  Sums& operator+=(const Sums& other) {
    distance += other.distance;
    squared += other.squared;
    difference += other.difference;
    largest_squared = std::max(largest_squared, other.largest_squared);
    return *this;
  }
};

// fill(first, out) writes the samples from `first` on.
template <class Fill>
Sums sum_samples(const Surface& from, const ClosestPointTree& to, std::size_t total, const Fill& fill) {
  return sum_pieces<Sums>(total, [&](std::size_t first, std::size_t count) {
    std::array<SurfaceSample, kPiece> buffer;
    const std::span<SurfaceSample> samples(buffer.data(), count);
    fill(first, samples);
    Sums sums;
    ClosestPoint closest;
    for (std::size_t i = 0; i < count; ++i) {
      const double squared_before = closest.squared_distance;
      closest = to.closest(point_at(from, samples[i].triangle, samples[i].barycentric), closest.triangle);
      sums.distance += std::sqrt(closest.squared_distance);
      sums.squared += closest.squared_distance;
      sums.largest_squared = std::max(sums.largest_squared, closest.squared_distance);
      const double difference = i == 0 ? 0 : closest.squared_distance - squared_before;
      sums.difference += difference * difference;
    }
    return sums;
  });
}

double largest_at_vertices(const Surface& from, const ClosestPointTree& to) {
  std::vector<bool> used(from.positions.size(), false);
  for (const Triangle& triangle : from.triangles) {
    for (const Index vertex : triangle) used[vertex] = true;
  }
  return sum_pieces<Sums>(from.positions.size(),
                          [&](std::size_t first, std::size_t count) {
                            Sums sums;
                            ClosestPoint closest;
                            for (std::size_t v = first; v < first + count; ++v) {
                              if (!used[v]) continue;
                              closest = to.closest(Vec3d(from.positions[v]), closest.triangle);
                              sums.largest_squared = std::max(sums.largest_squared, closest.squared_distance);
                            }
                            return sums;
                          })
      .largest_squared;
}

OneWayDistance measure_one_way(const Surface& from, const ClosestPointTree& to, std::size_t total, double percent,
                               const DistanceOptions& options) {
  Sums sums;
  if (options.sampling == Sampling::kArea) {
    const AreaSamples samples(from, total, options.samples.seed);
    sums = sum_samples(from, to, total, [&](std::size_t first, auto out) { samples.fill(first, out); });
  } else {
    const std::vector<SurfaceSample> samples = sample_like_metro(from, total, options.samples.seed);
    total = samples.size();
    sums = sum_samples(from, to, total, [&](std::size_t first, auto out) {
      std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(first), out.size(), out.begin());
    });
  }
  const auto n = static_cast<double>(total);
  const double rms = std::sqrt(sums.squared / n);
  const double squared_error = std::sqrt(sums.difference / 2) / n;  // of the mean square
  return {.rms = rms * percent,
          .mean = sums.distance / n * percent,
          .max = std::sqrt(std::max(sums.largest_squared, largest_at_vertices(from, to))) * percent,
          .rms_error = rms > 0 ? squared_error / (2 * rms) * percent : 0,
          .sample_count = total};
}

}  // namespace

Distance measure_distance(const Surface& original, const ClosestPointTree& original_tree, const Surface& approximation,
                          const ClosestPointTree& approximation_tree, const DistanceOptions& options) {
  assert(!original.triangles.empty() && !approximation.triangles.empty());
  std::size_t original_total = options.samples.total(original.triangles.size());
  std::size_t approximation_total = options.samples.total(approximation.triangles.size());
  if (options.sampling == Sampling::kMetro) {  // one total for both directions
    original_total = approximation_total = std::max(original_total, approximation_total);
  }

  Distance distance;
  distance.diagonal = bounding_box(original).diagonal();
  assert(distance.diagonal > 0);
  const double percent = 100 / distance.diagonal;
  distance.to_approximation = measure_one_way(original, approximation_tree, original_total, percent, options);
  distance.to_original = measure_one_way(approximation, original_tree, approximation_total, percent, options);

  const OneWayDistance &there = distance.to_approximation, &back = distance.to_original;
  distance.rms = std::max(there.rms, back.rms);
  distance.mean = std::max(there.mean, back.mean);
  distance.max = std::max(there.max, back.max);
  distance.rms_error = there.rms >= back.rms ? there.rms_error : back.rms_error;
  return distance;
}

Distance measure_distance(const Surface& original, const Surface& approximation, const DistanceOptions& options) {
  const ClosestPointTree original_tree(original), approximation_tree(approximation);
  return measure_distance(original, original_tree, approximation, approximation_tree, options);
}

}  // namespace limber::eval
