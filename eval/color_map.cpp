// SPDX-License-Identifier: Apache-2.0
#include "eval/color_map.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "eval/srgb.h"

namespace limber::eval {
namespace {

constexpr std::size_t kStepCount = 256;
using ColorTable = std::array<Vec3f, kStepCount + 1>;  // linear light

// x: lightness, y: green to red, z: blue to yellow.
using Oklab = Vec3d;

Vec3d linear_from_oklab(const Oklab& c) {
  const double l = c.x + 0.3963377774 * c.y + 0.2158037573 * c.z;
  const double m = c.x - 0.1055613458 * c.y - 0.0638541728 * c.z;
  const double s = c.x - 0.0894841775 * c.y - 1.2914855480 * c.z;
  const Vec3d cube{l * l * l, m * m * m, s * s * s};
  return {4.0767416621 * cube.x - 3.3077115913 * cube.y + 0.2309699292 * cube.z,
          -1.2684380046 * cube.x + 2.6097574011 * cube.y - 0.3413193965 * cube.z,
          -0.0041960863 * cube.x - 0.7034186147 * cube.y + 1.7076147010 * cube.z};
}

// A uniform cubic B-spline that starts and ends at the first and last control point; u in [0, control.size() - 1].
Oklab spline(std::span<const Oklab> control, double u) {
  const auto last = static_cast<std::ptrdiff_t>(control.size()) - 1;
  const auto segment = std::min(static_cast<std::ptrdiff_t>(u), last - 1);
  const double t = u - static_cast<double>(segment);
  const auto at = [&](std::ptrdiff_t i) -> Oklab {
    // Points beyond the ends mirror the ones inside.
    if (i < 0) return control[0] * 2.0 - control[1];
    if (i > last) return control[control.size() - 1] * 2.0 - control[control.size() - 2];
    return control[static_cast<std::size_t>(i)];
  };
  const double r = 1.0 - t;
  return (at(segment - 1) * (r * r * r) + at(segment) * (3.0 * t * t * t - 6.0 * t * t + 4.0) +
          at(segment + 1) * (3.0 * r * r * r - 6.0 * r * r + 4.0) + at(segment + 2) * (t * t * t)) *
         (1.0 / 6.0);
}

ColorTable make_table(std::span<const Oklab> control) {
  constexpr std::size_t kFine = 4096;
  const double end = static_cast<double>(control.size() - 1);
  const auto point = [&](std::size_t i) { return spline(control, end * static_cast<double>(i) / kFine); };
  std::vector<double> travelled(kFine + 1, 0.0);
  for (std::size_t i = 1; i <= kFine; ++i) travelled[i] = travelled[i - 1] + length(point(i) - point(i - 1));
  ColorTable table;
  std::size_t i = 0;
  for (std::size_t step = 0; step <= kStepCount; ++step) {
    const double wanted = travelled[kFine] * static_cast<double>(step) / kStepCount;
    while (i < kFine && travelled[i] < wanted) ++i;
    const Vec3d c = linear_from_oklab(point(i));
    const auto unit = [](double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); };
    table[step] = {unit(c.x), unit(c.y), unit(c.z)};
  }
  return table;
}

const ColorTable& table_of(ColorMap map) {
  static constexpr Oklab kHeatControl[] = {{0.93, 0.000, 0.030}, {0.88, 0.005, 0.110}, {0.78, 0.070, 0.150},
                                           {0.66, 0.150, 0.130}, {0.53, 0.180, 0.070}, {0.44, 0.150, -0.02},
                                           {0.32, 0.110, -0.08}};
  static constexpr Oklab kDepthControl[] = {{0.25, 0.020, -0.13}, {0.37, -0.01, -0.13}, {0.50, -0.06, -0.06},
                                            {0.63, -0.12, 0.030}, {0.78, -0.11, 0.140}, {0.92, -0.04, 0.170}};
  static constexpr Oklab kDivergingControl[] = {{0.38, -0.01, -0.15}, {0.54, -0.03, -0.13}, {0.74, -0.03, -0.07},
                                                {0.95, 0.000, 0.000}, {0.74, 0.080, 0.050}, {0.54, 0.150, 0.080},
                                                {0.38, 0.130, 0.060}};
  static const ColorTable heat = make_table(kHeatControl);
  static const ColorTable depth = make_table(kDepthControl);
  static const ColorTable diverging = make_table(kDivergingControl);
  return map == ColorMap::kHeat ? heat : map == ColorMap::kDepth ? depth : diverging;
}

}  // namespace

Vec3f map_color(ColorMap map, float t) {
  const ColorTable& table = table_of(map);
  if (!(t > 0.0f)) return table[0];
  if (t >= 1.0f) return table[kStepCount];
  const float place = t * static_cast<float>(kStepCount);
  const auto step = static_cast<std::size_t>(place);
  const float part = place - static_cast<float>(step);
  return table[step] * (1.0f - part) + table[step + 1] * part;
}

Rgba8 map_pixel(ColorMap map, float t) {
  const Vec3f c = map_color(map, t);
  return {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z), 255};
}

}  // namespace limber::eval
