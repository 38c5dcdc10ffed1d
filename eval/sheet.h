// SPDX-License-Identifier: Apache-2.0
// Pictures side by side, with labels, and the key to error colours.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "eval/color_map.h"
#include "eval/image.h"

namespace limber::eval {

struct SheetTile {
  Image image;
  std::string label;  // below the picture, one line; may be empty
};

struct SheetOptions {
  int columns = 0;           // 0: all tiles in one row
  int gap = 16;              // pixels around and between tiles
  double text_height = 0.0;  // of capital letters, in pixels; 0: to suit the size of the tiles
  Rgba8 background = kWhite;
  Rgba8 ink = kInk;
};

// Tiles from left to right, row by row, each centred in a cell as large as the largest tile; labels centred below. A
// label wider than its cell is set smaller. No tiles: an empty picture.
Image contact_sheet(std::span<const SheetTile> tiles, const SheetOptions& options = {});

struct ColorBar {
  ColorMap map = ColorMap::kHeat;
  float low = 0.0f;
  float high = 1.0f;
  std::string_view title = {};  // above the bar: what the numbers are, and their unit
};

// Draws an upright bar with five numbers at the right border of the picture, centred.
void draw_color_bar(Image& image, const ColorBar& bar, Rgba8 ink = kInk);

}  // namespace limber::eval
