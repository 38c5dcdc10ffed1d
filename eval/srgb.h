// SPDX-License-Identifier: Apache-2.0
// Between sRGB codes and linear light (IEC 61966-2-1), without the mathematics library, so that every machine gets
// the same codes.
#pragma once

#include <cstdint>

#include "eval/image.h"
#include "limber/base/vec.h"

namespace limber::eval {

// Linear light of an sRGB value in [0, 1]; values outside, and NaN, are brought to the nearest end (NaN to 0).
double linear_from_srgb(double value);

// The three colours of a pixel as linear light; alpha is not looked at.
Vec3f linear_from_srgb(Rgba8 color);

// The sRGB code nearest to a linear value; outside [0, 1] the nearest end; 0 for NaN.
std::uint8_t srgb_from_linear(float value);

// The code nearest to an alpha or another value without gamma.
std::uint8_t code_from_unit(float value);

// Straight-alpha pixel of linear light that is premultiplied by `alpha`.
Rgba8 pixel_from_premultiplied(const Vec3f& light, float alpha);

}  // namespace limber::eval
