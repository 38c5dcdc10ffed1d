// SPDX-License-Identifier: Apache-2.0
// Which triangle is seen where: visibility by edge functions in homogeneous coordinates (Olano and Greer, Triangle Scan
// Conversion using 2D Homogeneous Coordinates, 1997), which need no clipping. A sample on an edge that two triangles
// share belongs to exactly one of them; at a corner this holds up to rounding.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "eval/camera.h"
#include "limber/base/mesh.h"

namespace limber::eval {

inline constexpr int kTileSize = 32;  // pixels

// e_i(x, y) = a_i x + b_i y + c_i is at least 0 inside for i = 0, 1, 2; e_i / (e_0 + e_1 + e_2) are the
// perspective-correct barycentric coordinates; (e_0 + e_1 + e_2) / det is 1 / w.
struct EdgeFunctions {
  double a[3], b[3], c[3];
  double det = 0.0;  // > 0, or 0: no picture (degenerate, edge-on or not finite)
  bool front = true;

  double at(int i, double x, double y) const { return a[i] * x + (b[i] * y + c[i]); }
};

EdgeFunctions edge_functions(const ScreenPoint& p0, const ScreenPoint& p1, const ScreenPoint& p2);

// Places of the samples inside a pixel, in [0, 1).
struct SamplePattern {
  int count = 1;
  double x[16] = {0.5}, y[16] = {0.5};
};

// 1, 4, 8 or 16 samples, no two in one row or column; other counts are rounded down to one of these.
SamplePattern sample_pattern(int count);

// The tiles of a picture, row by row, and the triangles (or segments) whose box touches each, in rising order.
struct TileBins {
  int columns = 0, rows = 0;
  std::vector<std::size_t> offsets;  // [columns * rows + 1] into items
  std::vector<Index> items;
};

// Pixels [x0, x1) x [y0, y1) that something may touch; nothing where x0 >= x1 or y0 >= y1.
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// The box of the points in a picture of that size, grown by `reach` pixels; all of the picture where some points lie
// behind the eye; nothing where all do or one is not finite.
PixelBox pixel_box(std::span<const ScreenPoint> points, int width, int height, double reach);

// boxes: one for each item.
TileBins bin_boxes(std::span<const PixelBox> boxes, int width, int height);

// The items of a tile; none for bins that were never made.
std::span<const Index> items_of(const TileBins& bins, std::size_t tile);

// Visibility of one tile; reused between tiles.
struct TileSamples {
  PixelBox pixels;
  int sample_count = 1;
  std::vector<Index> triangle;       // [pixels of the tile, row by row][sample_count]; kNone: background
  std::vector<float> inverse_depth;  // as triangle; 1 / w, 0 for background

  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(((y - pixels.y0) * (pixels.x1 - pixels.x0) + (x - pixels.x0)) * sample_count);
  }
};

// Draws the triangles named by `items` in that order; of several at the same depth the first stays. Things nearer to
// the eye than `near` are not drawn.
void draw_tile(std::span<const Triangle> triangles, std::span<const ScreenPoint> points, std::span<const Index> items,
               const SamplePattern& pattern, double near, TileSamples& tile);

// Sets the tile to background.
void clear_tile(const TileBins& bins, std::size_t tile_index, int width, int height, int sample_count,
                TileSamples& tile);

}  // namespace limber::eval
