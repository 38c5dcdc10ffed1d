// SPDX-License-Identifier: Apache-2.0
#include "eval/raster.h"

#include <algorithm>
#include <cmath>

namespace limber::eval {
namespace {

// Which of two triangles owns a sample on their common edge: their edge functions are exact negatives of each other, so
// exactly one of them has this sign.
bool owns_its_zero(double a, double b) { return a > 0.0 || (a == 0.0 && b > 0.0); }

// Edge functions at all samples of a pixel relative to the pixel's corner, and their largest.
struct SampleOffsets {
  double value[3][16];
  double largest[3];
};

SampleOffsets sample_offsets(const EdgeFunctions& e, const SamplePattern& pattern) {
  SampleOffsets offsets;
  for (int i = 0; i < 3; ++i) {
    for (int s = 0; s < pattern.count; ++s) offsets.value[i][s] = e.a[i] * pattern.x[s] + e.b[i] * pattern.y[s];
    offsets.largest[i] = *std::max_element(offsets.value[i], offsets.value[i] + pattern.count);
  }
  return offsets;
}

}  // namespace

EdgeFunctions edge_functions(const ScreenPoint& p0, const ScreenPoint& p1, const ScreenPoint& p2) {
  const ScreenPoint* p[3] = {&p0, &p1, &p2};
  EdgeFunctions e;
  for (int i = 0; i < 3; ++i) {
    const ScreenPoint& q = *p[(i + 1) % 3];
    const ScreenPoint& r = *p[(i + 2) % 3];
    e.a[i] = q.y * r.w - q.w * r.y;
    e.b[i] = q.w * r.x - q.x * r.w;
    e.c[i] = q.x * r.y - q.y * r.x;
  }
  e.det = p0.x * e.a[0] + p0.y * e.b[0] + p0.w * e.c[0];
  if (!std::isfinite(e.det)) e.det = 0.0;
  // With y downwards, counter-clockwise corners have a negative determinant.
  e.front = e.det < 0.0;
  if (e.front) {
    e.det = -e.det;
    for (int i = 0; i < 3; ++i) e.a[i] = -e.a[i], e.b[i] = -e.b[i], e.c[i] = -e.c[i];
  }
  return e;
}

SamplePattern sample_pattern(int count) {
  SamplePattern pattern;
  if (count < 4) return pattern;
  pattern.count = count < 8 ? 4 : count < 16 ? 8 : 16;
  // Sample s lies in column s; its row is s with its bits reversed (a Hammersley set), which is well spread for every
  // power of two. Both are shifted to cell centres.
  const int bits = pattern.count == 4 ? 2 : pattern.count == 8 ? 3 : 4;
  for (int s = 0; s < pattern.count; ++s) {
    int row = 0;
    for (int bit = 0; bit < bits; ++bit) row |= ((s >> bit) & 1) << (bits - 1 - bit);
    pattern.x[s] = (s + 0.5) / pattern.count;
    pattern.y[s] = (row + 0.5) / pattern.count;
  }
  return pattern;
}

PixelBox pixel_box(std::span<const ScreenPoint> points, int width, int height, double reach) {
  std::size_t behind = 0;
  double x0 = width, y0 = height, x1 = 0.0, y1 = 0.0;
  for (const ScreenPoint& p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.w)) return {};
    if (p.w <= 0.0) {
      ++behind;
      continue;
    }
    const double x = p.x / p.w, y = p.y / p.w;
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  if (behind == points.size()) return {};
  if (behind > 0) return {0, 0, width, height};
  const auto clamp_to = [](double v, int limit) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(limit)));
  };
  return {clamp_to(std::floor(x0 - reach), width), clamp_to(std::floor(y0 - reach), height),
          clamp_to(std::ceil(x1 + reach), width), clamp_to(std::ceil(y1 + reach), height)};
}

TileBins bin_boxes(std::span<const PixelBox> boxes, int width, int height) {
  TileBins bins;
  bins.columns = (width + kTileSize - 1) / kTileSize;
  bins.rows = (height + kTileSize - 1) / kTileSize;
  bins.offsets.assign(static_cast<std::size_t>(bins.columns) * static_cast<std::size_t>(bins.rows) + 1, 0);
  const auto for_each_tile = [&](const PixelBox& box, const auto& visit) {
    if (box.x0 >= box.x1 || box.y0 >= box.y1) return;
    for (int row = box.y0 / kTileSize; row <= (box.y1 - 1) / kTileSize; ++row) {
      for (int column = box.x0 / kTileSize; column <= (box.x1 - 1) / kTileSize; ++column) {
        visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(bins.columns) +
              static_cast<std::size_t>(column));
      }
    }
  };
  for (const PixelBox& box : boxes) for_each_tile(box, [&](std::size_t tile) { ++bins.offsets[tile + 1]; });
  for (std::size_t i = 1; i < bins.offsets.size(); ++i) bins.offsets[i] += bins.offsets[i - 1];
  bins.items.resize(bins.offsets.back());
  std::vector<std::size_t> next(bins.offsets.begin(), bins.offsets.end() - 1);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for_each_tile(boxes[i], [&](std::size_t tile) { bins.items[next[tile]++] = static_cast<Index>(i); });
  }
  return bins;
}

std::span<const Index> items_of(const TileBins& bins, std::size_t tile) {
  if (bins.offsets.empty()) return {};
  return std::span(bins.items).subspan(bins.offsets[tile], bins.offsets[tile + 1] - bins.offsets[tile]);
}

void clear_tile(const TileBins& bins, std::size_t tile_index, int width, int height, int sample_count,
                TileSamples& tile) {
  const int row = static_cast<int>(tile_index) / bins.columns, column = static_cast<int>(tile_index) % bins.columns;
  tile.pixels = {column * kTileSize, row * kTileSize, std::min(width, (column + 1) * kTileSize),
                 std::min(height, (row + 1) * kTileSize)};
  tile.sample_count = sample_count;
  const std::size_t size = tile.offset(tile.pixels.x0, tile.pixels.y1);
  tile.triangle.assign(size, kNone);
  tile.inverse_depth.assign(size, 0.0f);
}

void draw_tile(std::span<const Triangle> triangles, std::span<const ScreenPoint> points, std::span<const Index> items,
               const SamplePattern& pattern, double near, TileSamples& tile) {
  const float largest_inverse_depth = static_cast<float>(1.0 / near);
  for (const Index item : items) {
    const Triangle& t = triangles[item];
    const ScreenPoint corners[3] = {points[t[0]], points[t[1]], points[t[2]]};
    const EdgeFunctions e = edge_functions(corners[0], corners[1], corners[2]);
    if (!(e.det > 0.0)) continue;
    const PixelBox box = pixel_box(corners, tile.pixels.x1, tile.pixels.y1, 0.0);
    const SampleOffsets offsets = sample_offsets(e, pattern);
    const double inverse_det = 1.0 / e.det;
    const bool owns[3] = {owns_its_zero(e.a[0], e.b[0]), owns_its_zero(e.a[1], e.b[1]), owns_its_zero(e.a[2], e.b[2])};
    for (int y = std::max(box.y0, tile.pixels.y0); y < box.y1; ++y) {
      for (int x = std::max(box.x0, tile.pixels.x0); x < box.x1; ++x) {
        const double corner[3] = {e.at(0, x, y), e.at(1, x, y), e.at(2, x, y)};
        if (corner[0] + offsets.largest[0] < 0.0 || corner[1] + offsets.largest[1] < 0.0 ||
            corner[2] + offsets.largest[2] < 0.0) {
          continue;
        }
        const std::size_t first = tile.offset(x, y);
        for (int s = 0; s < pattern.count; ++s) {
          const double e0 = corner[0] + offsets.value[0][s];
          const double e1 = corner[1] + offsets.value[1][s];
          const double e2 = corner[2] + offsets.value[2][s];
          if (e0 < 0.0 || e1 < 0.0 || e2 < 0.0) continue;
          if ((e0 == 0.0 && !owns[0]) || (e1 == 0.0 && !owns[1]) || (e2 == 0.0 && !owns[2])) continue;
          const float inverse_depth = static_cast<float>((e0 + e1 + e2) * inverse_det);
          const std::size_t sample = first + static_cast<std::size_t>(s);
          if (inverse_depth > tile.inverse_depth[sample] && inverse_depth <= largest_inverse_depth) {
            tile.inverse_depth[sample] = inverse_depth;
            tile.triangle[sample] = item;
          }
        }
      }
    }
  }
}

}  // namespace limber::eval
