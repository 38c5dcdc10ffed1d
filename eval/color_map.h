// SPDX-License-Identifier: Apache-2.0
// Colours for numbers. Every map is a smooth curve in Oklab (Ottosson, 2020), cut into steps of equal length there, so
// that equal differences of the number look equally large.
#pragma once

#include "eval/image.h"
#include "limber/base/vec.h"

namespace limber::eval {

enum class ColorMap {
  kHeat,       // pale, then yellow, orange, red and dark purple: error on a shaded surface
  kDepth,      // dark blue, green, yellow: reads well in black and white
  kDiverging,  // blue, near white, red: signed values around the middle of the range
};

// The colour at t in [0, 1] as linear light; t outside is brought to the nearest end, NaN to 0.
Vec3f map_color(ColorMap map, float t);

// The same as a pixel.
Rgba8 map_pixel(ColorMap map, float t);

}  // namespace limber::eval
