// SPDX-License-Identifier: Apache-2.0
#include "eval/report/error_distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limber::eval {
namespace {

constexpr double kLeast = 1e-9;  // percent of a diagonal: below what single precision holds
constexpr double kBinsPerOctave = 64;
constexpr std::size_t kBinCount = 64 * 44;

double bin_start(std::size_t bin) {
  return bin == 0 ? 0.0 : kLeast * std::exp2(static_cast<double>(bin - 1) / kBinsPerOctave);
}

}  // namespace

void ErrorDistribution::add(double distance) {
  assert(std::isfinite(distance) && distance >= 0);
  if (counts_.empty()) counts_.resize(kBinCount, 0);
  std::size_t bin = 0;
  if (distance >= kLeast) {
    bin = 1 + static_cast<std::size_t>(kBinsPerOctave * std::log2(distance / kLeast));
    bin = std::min(bin, kBinCount - 1);
  }
  ++counts_[bin];
  ++size_;
}

double ErrorDistribution::percentile(double share) const {
  const double wanted = share * static_cast<double>(size_);
  double below = 0;
  for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
    below += static_cast<double>(counts_[bin]);
    if (counts_[bin] > 0 && below >= wanted) return bin_start(bin + 1);
  }
  return 0;
}

std::vector<double> ErrorDistribution::shares(double high, std::size_t count) const {
  assert(high > 0);
  std::vector<double> shares(count + 1, 0.0);
  const double step = high / static_cast<double>(count);
  for (std::size_t bin = 0; bin < counts_.size(); ++bin) {
    if (counts_[bin] == 0) continue;
    // What lies in a fine bin is spread evenly over the steps that it touches.
    const double start = bin_start(bin), end = bin_start(bin + 1);
    const double amount = static_cast<double>(counts_[bin]) / static_cast<double>(size_);
    for (std::size_t k = std::min(static_cast<std::size_t>(std::min(start / step, 1e9)), count); k <= count; ++k) {
      const double low = std::max(start, step * static_cast<double>(k));
      const double until = k == count ? end : std::min(end, step * static_cast<double>(k + 1));
      if (until > low) shares[k] += amount * (until - low) / (end - start);
      if (k < count && step * static_cast<double>(k + 1) >= end) break;
    }
  }
  return shares;
}

}  // namespace limber::eval
