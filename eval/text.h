// SPDX-License-Identifier: Apache-2.0
// Small labels in pictures, in a plain font of strokes that looks clean at any size.
#pragma once

#include <string_view>

#include "eval/image.h"

namespace limber::eval {

// Pixels from the left end of the text to its right end. Sizes are those of capital letters, in pixels; letters reach
// 0.3 of that below the baseline. ASCII; what the font lacks is shown as a box.
double text_width(std::string_view text, double cap_height);

// Draws over the picture; what lies outside it is left out.
void draw_text(Image& image, double left, double baseline, std::string_view text, double cap_height, Rgba8 ink = kInk);

// Lays a colour over a pixel, in linear light; `share` in [0, 1] is scaled by the colour's alpha.
void blend(Rgba8& pixel, Rgba8 color, float share);

}  // namespace limber::eval
