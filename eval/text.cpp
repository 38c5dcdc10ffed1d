// SPDX-License-Identifier: Apache-2.0
#include "eval/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "eval/srgb.h"

namespace limber::eval {
namespace {

// A glyph is a list of strokes separated by spaces: '-' a polyline, '~' a smooth curve that starts and ends at its
// outer points, 'o' a smooth ring; then points, each a character for x ('0' is 0, steps of 1) and one for y ('e' is the
// baseline, steps of 1, upwards: 'a' below it, 'o' the height of small letters, 's' of capitals).
constexpr double kCapUnits = 14.0;
constexpr double kSpacing = 3.4;
constexpr double kSpaceWidth = 3.0;
constexpr double kPenShare = 0.13;  // of the cap height

struct Glyph {
  char character;
  std::string_view strokes;
};

constexpr Glyph kGlyphs[] = {
    {'!', "-0s0j -0e0e"},
    {'\'', "-0q0s"},
    {'"', "-0q0s -3q3s"},
    {'#', "-1e3s -5e7s -0i8i -0n8n"},
    {'%', "o0m4m4s0s o6e:e:k6k -1e9s"},
    {'&', "~9e2n2s6s6n0k0e6e8k"},
    {'(', "~3t0p0g3c"},
    {')', "~0t3p3g0c"},
    {'*', "-3l3r -0m6q -0q6m"},
    {'+', "-0j6j -3g3m"},
    {',', "-1f0c"},
    {'-', "-0j4j"},
    {'.', "-0e1e1f0f0e"},
    {'/', "-0c6t"},
    {'0', "o0e8e8s0s"},
    {'1', "-0p3s3e"},
    {'2', "~0o0s8s8m5j0e -0e8e"},
    {'3', "~0p0s7s7l2l ~2l8l8e0e0h"},
    {'4', "-6e6s0i8i"},
    {'5', "-7s1s0l ~0l2n8n8e0e0h"},
    {'6', "o0e8e8m0m ~6s0s0i"},
    {'7', "-0s8s3e"},
    {'8', "o0l8l8s0s o0e9e9l0l"},
    {'9', "o0k8k8s0s ~8n8e2e"},
    {':', "-0e1e1f0f0e -0l1l1m0m0l"},
    {';', "-1f0c -1m1m"},
    {'<', "-6f0j6n"},
    {'=', "-0h6h -0l6l"},
    {'>', "-0f6j0n"},
    {'?', "~0p0s7s7m3l3i -3e3e"},
    {'A', "-0e5s:e -1i9i"},
    {'B', "-0e0s4s ~4s8s8l4l -0l4l ~4l9l9e4e -0e4e"},
    {'C', "~9p9s0s0e9e9h"},
    {'D', "-3e0e0s3s ~3s:s:e3e"},
    {'E', "-7e0e0s7s -0l6l"},
    {'F', "-0e0s7s -0l6l"},
    {'G', "~9p9s0s0e9e9k -9k5k"},
    {'H', "-0e0s -8e8s -0l8l"},
    {'I', "-0e4e -0s4s -2e2s"},
    {'J', "-5s5i ~5i5e0e0h"},
    {'K', "-0e0s -8s0j -2l8e"},
    {'L', "-0s0e7e"},
    {'M', "-0e0s5j:s:e"},
    {'N', "-0e0s8e8s"},
    {'O', "o0e:e:s0s"},
    {'P', "-0e0s4s ~4s9s9k4k -0k4k"},
    {'Q', "o0e:e:s0s -6i:e"},
    {'R', "-0e0s4s ~4s9s9k4k -0k4k -4k8e"},
    {'S', "~8p8s0s0l8l8e0e0h"},
    {'T', "-0s8s -4s4e"},
    {'U', "-0s0i ~0i0e8e8i -8i8s"},
    {'V', "-0s5e:s"},
    {'W', "-0s3e7s;e>s"},
    {'X', "-0e8s -0s8e"},
    {'Y', "-0s4l8s -4l4e"},
    {'Z', "-0s8s0e8e"},
    {'[', "-3t0t0c3c"},
    {'\\', "-6c0t"},
    {']', "-0t3t3c0c"},
    {'^', "-0o3s6o"},
    {'_', "-0c8c"},
    {'a', "o0e7e7o0o -7o7e"},
    {'b', "-0e0s o0e7e7o0o"},
    {'c', "~7m7o0o0e7e7g"},
    {'d', "o0e7e7o0o -7s7e"},
    {'e', "-0j7j ~7j7o0o0e7e7g"},
    {'f', "~5s2s2o -2o2e -0o5o"},
    {'g', "o0e7e7o0o -7o7e ~7e7a0a0b"},
    {'h', "-0e0s ~0l0o7o7k -7k7e"},
    {'i', "-0e0o -0s0s"},
    {'j', "-2o2d ~2d2a0a -2s2s"},
    {'k', "-0e0s -6o0i -2k6e"},
    {'l', "-0s0e"},
    {'m', "-0e0o ~0l0o6o6k -6k6e ~6l6o<o<k -<k<e"},
    {'n', "-0e0o ~0l0o7o7k -7k7e"},
    {'o', "o0e7e7o0o"},
    {'p', "-0a0o o0e7e7o0o"},
    {'q', "o0e7e7o0o -7o7a"},
    {'r', "-0e0o ~0l0o4o"},
    {'s', "~6m6o0o0j6j6e0e0g"},
    {'t', "-2r2g ~2g2e5e -0o5o"},
    {'u', "-0o0i ~0i0e7e7i -7o7e"},
    {'v', "-0o3e6o"},
    {'w', "-0o3e5o7e:o"},
    {'x', "-0e6o -0o6e"},
    {'y', "-0o3e -6o2a"},
    {'z', "-0o6o0e6e"},
    {'|', "-0t0c"},
    {'~', "~0j2m5g7j"},
};

constexpr std::string_view kBox = "-0e7e7s0s0e";

struct Point {
  double x = 0.0, y = 0.0;
};

Point middle(Point a, Point b) { return {(a.x + b.x) * 0.5, (a.y + b.y) * 0.5}; }

using Line = std::array<Point, 2>;

std::string_view strokes_of(char character) {
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.character == character) return glyph.strokes;
  }
  return kBox;
}

// One arc of a quadratic B-spline, as short lines.
void add_arc(Point from, Point control, Point to, std::vector<Line>& lines) {
  constexpr int kPieces = 6;
  Point before = from;
  for (int i = 1; i <= kPieces; ++i) {
    const double t = static_cast<double>(i) / kPieces, r = 1.0 - t;
    const Point next{r * r * from.x + 2.0 * r * t * control.x + t * t * to.x,
                     r * r * from.y + 2.0 * r * t * control.y + t * t * to.y};
    lines.push_back({before, next});
    before = next;
  }
}

void add_stroke(char kind, const std::vector<Point>& p, std::vector<Line>& lines) {
  const std::size_t count = p.size();
  if (kind == '-' || count < 3) {
    for (std::size_t i = 0; i + 1 < count; ++i) lines.push_back({p[i], p[i + 1]});
  } else if (kind == 'o') {
    for (std::size_t i = 0; i < count; ++i) {
      const Point& control = p[(i + 1) % count];
      add_arc(middle(p[i], control), control, middle(control, p[(i + 2) % count]), lines);
    }
  } else {
    for (std::size_t i = 1; i + 1 < count; ++i) {
      const Point from = i == 1 ? p[0] : middle(p[i - 1], p[i]);
      const Point to = i + 2 == count ? p[count - 1] : middle(p[i], p[i + 1]);
      add_arc(from, p[i], to, lines);
    }
  }
}

struct GlyphShape {
  std::vector<Line> lines;  // in units
  double width = kSpaceWidth;
};

GlyphShape shape_of(char character) {
  GlyphShape shape;
  if (character == ' ') return shape;
  shape.width = 0.0;
  const std::string_view code = strokes_of(character);
  for (std::size_t i = 0; i < code.size();) {
    const char kind = code[i++];
    std::vector<Point> points;
    while (i + 1 < code.size() && code[i] != ' ') {
      points.push_back({static_cast<double>(code[i] - '0'), static_cast<double>(code[i + 1] - 'e')});
      shape.width = std::max(shape.width, points.back().x);
      i += 2;
    }
    ++i;
    add_stroke(kind, points, shape.lines);
  }
  return shape;
}

double distance_to(const Line& line, double x, double y) {
  const double dx = line[1].x - line[0].x, dy = line[1].y - line[0].y;
  const double square = dx * dx + dy * dy;
  const double along =
      square > 0.0 ? std::clamp(((x - line[0].x) * dx + (y - line[0].y) * dy) / square, 0.0, 1.0) : 0.0;
  const double ex = x - line[0].x - along * dx, ey = y - line[0].y - along * dy;
  return std::sqrt(ex * ex + ey * ey);
}

void draw_shape(Image& image, const GlyphShape& shape, Point origin, double unit, double pen, Rgba8 ink) {
  std::vector<Line> lines;
  double x0 = image.width, y0 = image.height, x1 = 0.0, y1 = 0.0;
  for (const Line& line : shape.lines) {
    Line placed;
    for (std::size_t k = 0; k < 2; ++k) {
      placed[k] = {origin.x + line[k].x * unit, origin.y - line[k].y * unit};
      x0 = std::min(x0, placed[k].x), x1 = std::max(x1, placed[k].x);
      y0 = std::min(y0, placed[k].y), y1 = std::max(y1, placed[k].y);
    }
    lines.push_back(placed);
  }
  const double reach = 0.5 * pen + 1.0;
  const int left = std::max(0, static_cast<int>(x0 - reach));
  const int right = std::min(image.width - 1, static_cast<int>(x1 + reach));
  const int bottom = std::min(image.height - 1, static_cast<int>(y1 + reach));
  for (int y = std::max(0, static_cast<int>(y0 - reach)); y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      double nearest = reach;
      for (const Line& line : lines) nearest = std::min(nearest, distance_to(line, x + 0.5, y + 0.5));
      blend(image.at(x, y), ink, static_cast<float>(std::clamp(0.5 * pen + 0.5 - nearest, 0.0, 1.0)));
    }
  }
}

}  // namespace

void blend(Rgba8& pixel, Rgba8 color, float share) {
  const float over = share * static_cast<float>(color.a) / 255.0f;
  if (!(over > 0.0f)) return;
  const float under = static_cast<float>(pixel.a) / 255.0f * (1.0f - over);
  pixel = pixel_from_premultiplied(linear_from_srgb(color) * over + linear_from_srgb(pixel) * under, over + under);
}

double text_width(std::string_view text, double cap_height) {
  double units = 0.0;
  for (const char c : text) units += shape_of(c).width + kSpacing;
  return std::max(0.0, units - kSpacing) * cap_height / kCapUnits;
}

void draw_text(Image& image, double left, double baseline, std::string_view text, double cap_height, Rgba8 ink) {
  const double unit = cap_height / kCapUnits;
  const double pen = std::max(1.1, kPenShare * cap_height);
  double x = left;
  for (const char c : text) {
    const GlyphShape shape = shape_of(c);
    draw_shape(image, shape, {x, baseline}, unit, pen, ink);
    x += (shape.width + kSpacing) * unit;
  }
}

}  // namespace limber::eval
