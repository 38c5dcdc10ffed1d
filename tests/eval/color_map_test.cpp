// SPDX-License-Identifier: Apache-2.0
#include "eval/color_map.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

#include "eval/srgb.h"

namespace limber::eval {
namespace {

Vec3d oklab_of(const Vec3f& c) {
  const double l = std::cbrt(0.4122214708 * c.x + 0.5363325363 * c.y + 0.0514459929 * c.z);
  const double m = std::cbrt(0.2119034982 * c.x + 0.6806995451 * c.y + 0.1073969566 * c.z);
  const double s = std::cbrt(0.0883024619 * c.x + 0.2817188376 * c.y + 0.6299787005 * c.z);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

TEST(MapColor, MakesStepsThatLookEquallyLarge) {
  for (const ColorMap map : {ColorMap::kHeat, ColorMap::kDepth, ColorMap::kDiverging}) {
    std::vector<double> steps;
    double total = 0.0;
    for (int i = 0; i < 32; ++i) {
      const auto at = [&](int k) { return oklab_of(map_color(map, static_cast<float>(k) / 32.0f)); };
      steps.push_back(length(at(i + 1) - at(i)));
      total += steps.back();
    }
    for (const double step : steps) EXPECT_NEAR(step, total / 32.0, 0.30 * total / 32.0);
  }
}

TEST(MapColor, ChangesLightnessInOneDirectionSoThatItReadsInGrey) {
  for (int i = 0; i < 64; ++i) {
    const float t = static_cast<float>(i) / 64.0f, next = static_cast<float>(i + 1) / 64.0f;
    EXPECT_GT(oklab_of(map_color(ColorMap::kHeat, t)).x, oklab_of(map_color(ColorMap::kHeat, next)).x) << i;
    EXPECT_LT(oklab_of(map_color(ColorMap::kDepth, t)).x, oklab_of(map_color(ColorMap::kDepth, next)).x) << i;
  }
}

TEST(MapColor, HoldsItsEndsBeyondTheRange) {
  for (const ColorMap map : {ColorMap::kHeat, ColorMap::kDepth, ColorMap::kDiverging}) {
    EXPECT_EQ(map_color(map, -1.0f), map_color(map, 0.0f));
    EXPECT_EQ(map_color(map, std::numeric_limits<float>::quiet_NaN()), map_color(map, 0.0f));
    EXPECT_EQ(map_color(map, std::numeric_limits<float>::infinity()), map_color(map, 1.0f));
    EXPECT_NE(map_pixel(map, 0.0f), map_pixel(map, 1.0f));
  }
}

TEST(Srgb, BringsEveryCodeBack) {
  for (int code = 0; code < 256; ++code) {
    const auto byte = static_cast<std::uint8_t>(code);
    EXPECT_EQ(srgb_from_linear(linear_from_srgb(Rgba8{byte, 0, 0, 255}).x), byte);
    EXPECT_EQ(code_from_unit(static_cast<float>(code) / 255.0f), byte);
  }
}

TEST(Srgb, AgreesWithTheStandardsFormula) {
  for (int i = 0; i <= 1000; ++i) {
    const double v = i / 1000.0;
    const double expected = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(linear_from_srgb(v), expected, 1e-14);
    const double linear = v;
    const double code = 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
    EXPECT_NEAR(srgb_from_linear(static_cast<float>(linear)), code, 0.501);
  }
}

}  // namespace
}  // namespace limber::eval
