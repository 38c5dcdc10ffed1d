// SPDX-License-Identifier: Apache-2.0
#include "eval/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "eval/text.h"

namespace limber::eval {
namespace {

void paste(const Image& from, int left, int top, Image& onto) {
  for (int y = 0; y < from.height; ++y) {
    std::copy_n(from.pixels.begin() + static_cast<std::ptrdiff_t>(y) * from.width, from.width,
                onto.pixels.begin() + static_cast<std::ptrdiff_t>(top + y) * onto.width + left);
  }
}

void draw_centered(Image& image, double center, double baseline, double room, std::string_view text, double height,
                   Rgba8 ink) {
  const double wide = text_width(text, height);
  const double fitted = wide > room ? height * room / wide : height;
  draw_text(image, center - 0.5 * text_width(text, fitted), baseline, text, fitted, ink);
}

}  // namespace

Image contact_sheet(std::span<const SheetTile> tiles, const SheetOptions& options) {
  if (tiles.empty()) return {};
  int cell_width = 1, cell_height = 1;
  bool labelled = false;
  for (const SheetTile& tile : tiles) {
    cell_width = std::max(cell_width, tile.image.width);
    cell_height = std::max(cell_height, tile.image.height);
    labelled = labelled || !tile.label.empty();
  }
  const int count = static_cast<int>(tiles.size());
  const int columns = options.columns > 0 ? std::min(options.columns, count) : count;
  const int rows = (count + columns - 1) / columns;
  const double text_height =
      options.text_height > 0.0 ? options.text_height : std::clamp(cell_width * 0.026, 8.0, 28.0);
  const int label_room = labelled ? static_cast<int>(std::ceil(2.4 * text_height)) : 0;
  const int gap = std::max(0, options.gap);

  Image sheet(columns * (cell_width + gap) + gap, rows * (cell_height + label_room + gap) + gap, options.background);
  for (int i = 0; i < count; ++i) {
    const SheetTile& tile = tiles[static_cast<std::size_t>(i)];
    const int left = gap + (i % columns) * (cell_width + gap);
    const int top = gap + (i / columns) * (cell_height + label_room + gap);
    paste(tile.image, left + (cell_width - tile.image.width) / 2, top + (cell_height - tile.image.height) / 2, sheet);
    draw_centered(sheet, left + 0.5 * cell_width, top + cell_height + 1.7 * text_height, cell_width, tile.label,
                  text_height, options.ink);
  }
  return sheet;
}

void draw_color_bar(Image& image, const ColorBar& bar, Rgba8 ink) {
  constexpr int kNumberCount = 5;
  const double text_height = std::clamp(0.016 * image.height, 7.0, 24.0);
  std::array<std::string, kNumberCount> numbers;
  double number_width = 0.0;
  for (int i = 0; i < kNumberCount; ++i) {
    const float share = static_cast<float>(i) / (kNumberCount - 1);
    std::string& number = numbers[static_cast<std::size_t>(i)];
    number = fmt::format("{:.3g}", bar.low * (1.0f - share) + bar.high * share);
    number_width = std::max(number_width, text_width(number, text_height));
  }
  const double margin = 1.6 * text_height;
  const int bar_width = std::max(6, static_cast<int>(1.3 * text_height));
  const int bar_height = std::max(kNumberCount, static_cast<int>(0.42 * image.height));
  const int left = static_cast<int>(image.width - margin - number_width - 1.1 * text_height) - bar_width;
  const int top = (image.height - bar_height) / 2;
  for (int y = std::max(0, top); y < std::min(image.height, top + bar_height); ++y) {
    const float share = 1.0f - (static_cast<float>(y - top) + 0.5f) / static_cast<float>(bar_height);
    for (int x = std::max(0, left); x < std::min(image.width, left + bar_width); ++x) {
      image.at(x, y) = map_pixel(bar.map, share);
    }
  }
  for (int i = 0; i < kNumberCount; ++i) {
    const double y = top + bar_height * (1.0 - static_cast<double>(i) / (kNumberCount - 1));
    const int row = std::clamp(static_cast<int>(y), top, top + bar_height - 1);
    for (int x = left + bar_width; x < left + bar_width + static_cast<int>(0.5 * text_height); ++x) {
      if (x >= 0 && x < image.width && row >= 0 && row < image.height) blend(image.at(x, row), ink, 1.0f);
    }
    draw_text(image, left + bar_width + 0.9 * text_height, row + 0.5 + 0.5 * text_height,
              numbers[static_cast<std::size_t>(i)], text_height, ink);
  }
  const double title_width = text_width(bar.title, text_height);
  const double title_left = std::min(static_cast<double>(left), image.width - margin - title_width);
  draw_text(image, title_left, top - 1.4 * text_height, bar.title, text_height, ink);
}

}  // namespace limber::eval
