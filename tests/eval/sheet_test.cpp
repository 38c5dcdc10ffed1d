// SPDX-License-Identifier: Apache-2.0
#include "eval/sheet.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "eval/text.h"

namespace limber::eval {
namespace {

std::ptrdiff_t changed_pixels(const Image& image, Rgba8 before) {
  return std::count_if(image.pixels.begin(), image.pixels.end(), [&](Rgba8 p) { return p != before; });
}

TEST(ContactSheet, PutsTilesInRowsAndLabelsBelow) {
  const Rgba8 red{200, 0, 0, 255}, blue{0, 0, 200, 255};
  const std::vector<SheetTile> tiles = {
      {Image(40, 30, red), "one"}, {Image(20, 10, blue), ""}, {Image(40, 30, red), ""}};
  const Image sheet = contact_sheet(tiles, {.columns = 2, .gap = 10, .text_height = 10.0});
  EXPECT_EQ(sheet.width, 10 + 50 + 50);
  EXPECT_EQ(sheet.height, 10 + 64 + 64);
  EXPECT_EQ(sheet.at(10, 10), red);
  EXPECT_EQ(sheet.at(49, 39), red);
  EXPECT_EQ(sheet.at(50, 39), kWhite);
  EXPECT_EQ(sheet.at(60 + 20, 10 + 15), blue) << "a small tile lies in the middle of its cell";
  EXPECT_EQ(sheet.at(60, 10), kWhite);
  const auto dark_in = [&](int x0, int x1) {
    int dark = 0;
    for (int y = 40; y < 64; ++y) {
      for (int x = x0; x < x1; ++x) dark += sheet.at(x, y).r < 128 ? 1 : 0;
    }
    return dark;
  };
  EXPECT_GT(dark_in(10, 50), 10);
  EXPECT_EQ(dark_in(60, 100), 0);
}

TEST(ContactSheet, IsEmptyWithoutTiles) { EXPECT_EQ(contact_sheet({}), Image{}); }

TEST(DrawColorBar, ShowsTheEndsOfTheMapOneAboveTheOther) {
  Image image(400, 300, kWhite);
  draw_color_bar(image, {.map = ColorMap::kDepth, .low = 0.0f, .high = 0.5f, .title = "error"});
  const auto nearest_to = [&](Rgba8 wanted) {
    int best = 1 << 20, row = -1;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Rgba8 p = image.at(x, y);
        const int apart = std::abs(p.r - wanted.r) + std::abs(p.g - wanted.g) + std::abs(p.b - wanted.b);
        if (apart < best) best = apart, row = y;
      }
    }
    EXPECT_LT(best, 12);
    return row;
  };
  EXPECT_LT(nearest_to(map_pixel(ColorMap::kDepth, 1.0f)), nearest_to(map_pixel(ColorMap::kDepth, 0.0f)));
}

TEST(DrawColorBar, IsHarmlessInATinyPicture) {
  Image image(9, 4, kWhite);
  draw_color_bar(image, {.title = "a title that does not fit"});
  EXPECT_EQ(image.width, 9);
}

TEST(DrawText, StaysInsideItsWidthAndBetweenItsLines) {
  for (char c = '!'; c <= '~'; ++c) {
    Image image(80, 80, kWhite);
    const std::string text(1, c);
    draw_text(image, 30.0, 50.0, text, 20.0);
    EXPECT_GT(changed_pixels(image, kWhite), 3) << c;
    const double right = 30.0 + text_width(text, 20.0);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (image.at(x, y) == kWhite) continue;
        EXPECT_GE(x, 26) << c;
        EXPECT_LE(x, right + 3.0) << c;
        EXPECT_GE(y, 50 - 25) << c;
        EXPECT_LE(y, 50 + 9) << c;
      }
    }
  }
}

TEST(DrawText, GivesEveryCharacterAFormOfItsOwn) {
  std::vector<Image> forms;
  for (char c = '!'; c <= '~'; ++c) {
    if (std::string_view("$@`{}").find(c) != std::string_view::npos) continue;  // shown as a box
    Image image(40, 40, kWhite);
    draw_text(image, 10.0, 28.0, std::string_view(&c, 1), 16.0);
    EXPECT_EQ(std::count(forms.begin(), forms.end(), image), 0) << c;
    forms.push_back(image);
  }
}

TEST(DrawText, DoesNotLeaveThePicture) {
  Image image(10, 10, kTransparent);
  draw_text(image, -30.0, 5.0, "far too long for this", 12.0);
  draw_text(image, 500.0, 500.0, "outside", 12.0);
  EXPECT_GT(changed_pixels(image, kTransparent), 0);
}

TEST(Blend, IsTheColorItselfOnATransparentPixel) {
  Rgba8 pixel = kTransparent;
  blend(pixel, {10, 200, 30, 255}, 0.5f);
  EXPECT_EQ(pixel, (Rgba8{10, 200, 30, 128}));
}

}  // namespace
}  // namespace limber::eval
