// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/motion_factors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace limber {
namespace {

// One coordinate: the displacement that is to be predicted, and what it is combined from (finest_positions.h).
struct Sample {
  double displacement;
  std::array<double, 3> terms;  // v, sum w d, - sum w v
};

using Factors = std::array<double, 3>;

constexpr int kIterations = 4;

std::vector<Sample> collect_samples(const Traversal& traversal, FinestPositions& finest,
                                    std::span<const Lattice> actual) {
  const auto weights = finest.motion_weights();
  const auto last = finest.positions(), before = finest.positions_before();
  std::vector<Sample> samples;
  samples.reserve(3 * actual.size());
  for (Index i = 0; i < actual.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto displacement = [&](Index j) { return static_cast<double>(actual[j][k]) - last[j][k]; };
      const auto velocity = [&](Index j) { return static_cast<double>(last[j][k]) - before[j][k]; };
      Sample sample{displacement(i), {velocity(i), 0.0, 0.0}};
      for (Index s = traversal.sources.begin[i]; s < traversal.sources.begin[i + 1]; ++s) {
        const Index j = traversal.sources.data[s];
        const double weight = weights[s] / double{1 << kWeightBits};
        sample.terms[1] += weight * displacement(j);
        sample.terms[2] -= weight * velocity(j);
      }
      samples.push_back(sample);
    }
  }
  return samples;
}

double residual(const Sample& sample, const Factors& factors) {
  return sample.displacement - sample.terms[0] * factors[0] - sample.terms[1] * factors[1] -
         sample.terms[2] * factors[2];
}

// Gauss-Jordan on the normal equations; a little ridge keeps a term that never varies at 0.
Factors weighted_least_squares(std::span<const Sample> samples, const Factors& previous) {
  double a[3][4]{};
  for (const Sample& sample : samples) {
    const double weight = 1.0 / (std::fabs(residual(sample, previous)) + 1.0);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) a[r][c] += weight * sample.terms[r] * sample.terms[c];
      a[r][3] += weight * sample.terms[r] * sample.displacement;
    }
  }
  for (std::size_t r = 0; r < 3; ++r) a[r][r] += 1e-3 + 1e-6 * a[r][r];
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t other = 0; other < 3; ++other) {
      if (other == r) continue;
      const double ratio = a[other][r] / a[r][r];
      for (std::size_t c = r; c < 4; ++c) a[other][c] -= ratio * a[r][c];
    }
  }
  return {a[0][3] / a[0][0], a[1][3] / a[1][1], a[2][3] / a[2][2]};
}

// What the residuals cost, about: the sum of their binary exponents.
std::int64_t cost(std::span<const Sample> samples, const Factors& factors) {
  std::int64_t sum = 0;
  for (const Sample& sample : samples) sum += std::ilogb(1.0 + std::fabs(residual(sample, factors)));
  return sum;
}

std::int16_t fixed_point(double factor) {
  return static_cast<std::int16_t>(
      std::clamp(std::floor(factor * (1 << kFactorBits) + 0.5), -double{kMostFactor}, double{kMostFactor}));
}

}  // namespace

MotionFactors best_motion_factors(const Traversal& traversal, FinestPositions& finest,
                                  std::span<const Lattice> actual) {
  const std::vector<Sample> samples = collect_samples(traversal, finest, actual);
  Factors fitted{0.0, 1.0, 0.0};
  for (int i = 0; i < kIterations; ++i) fitted = weighted_least_squares(samples, fitted);
  const std::array<Factors, 3> choices{Factors{0.0, 1.0, 0.0}, Factors{1.0, 1.0, 1.0}, fitted};
  const Factors* best = nullptr;
  std::int64_t least = 0;
  for (const Factors& factors : choices) {
    const std::int64_t here = cost(samples, factors);
    if (best == nullptr || here < least) best = &factors, least = here;
  }
  return {fixed_point((*best)[0]), fixed_point((*best)[1]), fixed_point((*best)[2])};
}

}  // namespace limber
