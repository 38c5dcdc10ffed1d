// SPDX-License-Identifier: Apache-2.0
#include "eval/report/axis.h"

#include <algorithm>
#include <cmath>

#include "eval/report/words.h"

namespace limber::eval {
namespace {

// The least of 1, 2, 5 times a power of ten that is not below.
double round_step(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least * (1 - 1e-9)) return factor * decade;
  }
  return 10 * decade;
}

void add_multiples(Axis& axis, double step) {
  const auto first = static_cast<long long>(std::ceil(axis.low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(axis.high / step + 1e-9));
  for (long long k = first; k <= last; ++k) axis.ticks.push_back(static_cast<double>(k) * step);
}

double transformed(Scale scale, double value) {
  switch (scale) {
    case Scale::kLinear:
      return value;
    case Scale::kLogarithmic:
      return std::log(std::max(value, 1e-300));
    case Scale::kSquareRoot:
      return std::sqrt(std::max(value, 0.0));
  }
  return value;
}

}  // namespace

double Axis::place(double value) const {
  const double start = transformed(scale, low), end = transformed(scale, high);
  return end > start ? std::clamp((transformed(scale, value) - start) / (end - start), 0.0, 1.0) : 0.5;
}

Axis linear_axis(double low, double high, int wanted) {
  if (!std::isfinite(low)) low = 0;
  if (!std::isfinite(high) || !(high > low)) high = low + (low == 0 ? 1 : std::abs(low));
  Axis axis{.low = low, .high = high, .ticks = {}};
  const double step = round_step((high - low) / wanted);
  axis.high = std::ceil(high / step - 1e-9) * step;
  add_multiples(axis, step);
  return axis;
}

Axis frame_axis(double low, double high, int wanted) {
  Axis axis{.low = low, .high = high, .ticks = {}};
  if (!(high > low)) {
    axis.ticks = {low};
    return axis;
  }
  add_multiples(axis, std::max(1.0, round_step((high - low) / wanted)));
  return axis;
}

Axis logarithmic_axis(double low, double high) {
  if (!std::isfinite(high) || !(high > 0)) high = 1;
  if (!std::isfinite(low) || !(low > 0)) low = high / 1000;
  low = std::min(low, high / 2);
  Axis axis{.scale = Scale::kLogarithmic, .low = low, .high = high, .ticks = {}};
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  const bool dense = last - first <= 4;
  // The ends are the ticks that enclose the values.
  double below = 0, above = 0;
  std::vector<double> candidates;
  for (int decade = first; decade <= last; ++decade) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor == 1.0 || dense) candidates.push_back(factor * std::pow(10.0, decade));
    }
  }
  for (const double tick : candidates) {
    if (tick <= low * (1 + 1e-9)) below = tick;
    if (above == 0 && tick >= high * (1 - 1e-9)) above = tick;
  }
  axis.low = below, axis.high = above;
  for (const double tick : candidates) {
    if (tick >= below * (1 - 1e-9) && tick <= above * (1 + 1e-9)) axis.ticks.push_back(tick);
  }
  return axis;
}

Axis share_axis(double high) {
  Axis axis{.scale = Scale::kSquareRoot, .low = 0, .high = 0.01, .ticks = {0}};
  for (const double tick : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
    axis.high = tick;
    axis.ticks.push_back(tick);
    if (tick >= high) break;
  }
  return axis;
}

std::string tick_label(const Axis& axis, double tick) {
  if (tick == 0) return "0";
  if (axis.scale == Scale::kLogarithmic) return number(tick, 1);
  double step = std::abs(tick);
  for (std::size_t i = 1; i < axis.ticks.size(); ++i) step = std::min(step, axis.ticks[i] - axis.ticks[i - 1]);
  const int digits = 1 + static_cast<int>(std::floor(std::log10(std::abs(tick)) + 1e-9)) -
                     static_cast<int>(std::floor(std::log10(step) + 1e-9));
  return number(tick, std::clamp(digits, 1, 9));
}

}  // namespace limber::eval
