// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limber {

LatticeChoice choose_lattice(double tolerance, const Box& box) {
  constexpr int kFloatBits = 24, kLeastExponent = -149, kMostMultiple = 1 << 20;
  const double widest = 2.0 * tolerance / std::sqrt(3.0) * (1.0 - 1e-9);
  const double size = std::max({std::fabs(box.low.x), std::fabs(box.low.y), std::fabs(box.low.z), std::fabs(box.high.x),
                                std::fabs(box.high.y), std::fabs(box.high.z)});
  if (!(widest > 0.0) || !(size > 0.0)) return {};
  int exponent = std::max(std::ilogb(8.0 * size) + 1 - kFloatBits, kLeastExponent);
  double multiple = std::floor(std::ldexp(widest, -exponent));
  while (multiple > kMostMultiple) multiple = std::floor(std::ldexp(widest, -++exponent));
  if (multiple < 1.0) {
    exponent = std::ilogb(widest);
    multiple = 1.0;
  }
  if (exponent < kLeastExponent) return {};
  const double unit = std::ldexp(1.0, exponent);
  const auto to_unit = [unit](double x) { return std::floor(x / unit + 0.5) * unit; };
  const Vec3d center = box.center();
  const double step = multiple * unit;
  if (size + step * 2147483648.0 > std::numeric_limits<float>::max() / 2) return {};
  return {{to_unit(center.x), to_unit(center.y), to_unit(center.z)}, step};
}

}  // namespace limber
