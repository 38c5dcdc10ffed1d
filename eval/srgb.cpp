// SPDX-License-Identifier: Apache-2.0
#include "eval/srgb.h"

#include <array>
#include <cstddef>

namespace limber::eval {
namespace {

// Newton's method for t^5 = a with a in [0.001, 1]: from 1 it falls towards the root, and 16 steps leave no error.
double fifth_root(double a) {
  double t = 1.0;
  for (int step = 0; step < 16; ++step) t -= (t - a / (t * t * t * t)) / 5.0;
  return t;
}

constexpr int kBinCount = 4096;

struct EncodeTable {
  std::array<float, 256> upper;                    // linear value at which code k becomes k + 1; the last is never met
  std::array<std::uint8_t, kBinCount + 1> lowest;  // the code at the low end of each bin of linear light
};

EncodeTable make_encode_table() {
  EncodeTable table{};
  for (std::size_t k = 0; k < 255; ++k) {
    table.upper[k] = static_cast<float>(linear_from_srgb((static_cast<double>(k) + 0.5) / 255.0));
  }
  table.upper[255] = 2.0f;
  std::size_t code = 0;
  for (std::size_t bin = 0; bin <= kBinCount; ++bin) {
    while (table.upper[code] <= static_cast<float>(bin) / static_cast<float>(kBinCount)) ++code;
    table.lowest[bin] = static_cast<std::uint8_t>(code);
  }
  return table;
}

std::array<float, 256> make_decode_table() {
  std::array<float, 256> table{};
  for (std::size_t k = 0; k < 256; ++k) {
    table[k] = static_cast<float>(linear_from_srgb(static_cast<double>(k) / 255.0));
  }
  return table;
}

}  // namespace

double linear_from_srgb(double value) {
  if (!(value > 0.0)) return 0.0;
  if (value >= 1.0) return 1.0;
  if (value <= 0.04045) return value / 12.92;
  const double base = (value + 0.055) / 1.055;
  const double square = base * base;
  return square * fifth_root(square);
}

Vec3f linear_from_srgb(Rgba8 color) {
  static const std::array<float, 256> table = make_decode_table();
  return {table[color.r], table[color.g], table[color.b]};
}

std::uint8_t srgb_from_linear(float value) {
  static const EncodeTable table = make_encode_table();
  if (!(value > 0.0f)) return 0;
  if (value >= 1.0f) return 255;
  std::size_t code = table.lowest[static_cast<std::size_t>(value * static_cast<float>(kBinCount))];
  while (table.upper[code] <= value) ++code;
  return static_cast<std::uint8_t>(code);
}

std::uint8_t code_from_unit(float value) {
  if (!(value > 0.0f)) return 0;
  return value >= 1.0f ? std::uint8_t{255} : static_cast<std::uint8_t>(value * 255.0f + 0.5f);
}

Rgba8 pixel_from_premultiplied(const Vec3f& light, float alpha) {
  if (!(alpha > 0.0f)) return kTransparent;
  const float scale = 1.0f / alpha;
  return {srgb_from_linear(light.x * scale), srgb_from_linear(light.y * scale), srgb_from_linear(light.z * scale),
          code_from_unit(alpha)};
}

}  // namespace limber::eval
