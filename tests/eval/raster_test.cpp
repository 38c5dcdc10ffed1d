// SPDX-License-Identifier: Apache-2.0
#include "eval/raster.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <vector>

namespace limber::eval {
namespace {

TileSamples draw_one_tile(const std::vector<Triangle>& triangles, const std::vector<ScreenPoint>& points, int samples) {
  TileBins bins;
  bins.columns = bins.rows = 1;
  TileSamples tile;
  clear_tile(bins, 0, kTileSize, kTileSize, samples, tile);
  std::vector<Index> items(triangles.size());
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = static_cast<Index>(i);
  draw_tile(triangles, points, items, sample_pattern(samples), 1e-6, tile);
  return tile;
}

ScreenPoint at(double x, double y, double w) { return {x * w, y * w, w}; }

TEST(SamplePattern, UsesEachRowAndColumnOnce) {
  for (const int count : {4, 8, 16}) {
    const SamplePattern pattern = sample_pattern(count);
    ASSERT_EQ(pattern.count, count);
    std::set<int> columns, rows;
    for (int s = 0; s < count; ++s) {
      columns.insert(static_cast<int>(pattern.x[s] * count));
      rows.insert(static_cast<int>(pattern.y[s] * count));
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
  }
  EXPECT_EQ(sample_pattern(3).count, 1);
  EXPECT_EQ(sample_pattern(99).count, 16);
}

TEST(DrawTile, CoversTheAreaOfAKnownTriangle) {
  const TileSamples tile = draw_one_tile({{0, 1, 2}}, {at(2, 3, 1), at(26, 5, 1), at(9, 29, 1)}, 16);
  const double area = 0.5 * std::abs(24.0 * 26.0 - 2.0 * 7.0);
  const auto covered = std::count(tile.triangle.begin(), tile.triangle.end(), Index{0});
  EXPECT_NEAR(static_cast<double>(covered) / 16.0, area, 0.01 * area);
}

// Triangles that tile a square leave no hole and take no sample twice, wherever their corners lie on the sample grid.
TEST(DrawTile, GivesEverySampleOfATiledSquareToExactlyOneTriangle) {
  std::uint32_t state = 1;
  const auto random = [&state] {
    return state = state * 1664525u + 1013904223u, static_cast<double>(state >> 8) / (1 << 24);
  };
  for (int round = 0; round < 20; ++round) {
    // Even rounds place corners on multiples of an eighth, where samples lie exactly on edges and corners.
    const int n = 5;
    std::vector<ScreenPoint> points;
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        double x = 8.0 * i, y = 8.0 * j;
        if (i > 0 && i < n - 1) x += 3.6 * random() - 1.8;
        if (j > 0 && j < n - 1) y += 3.6 * random() - 1.8;
        if (round % 2 == 0) x = std::round(x * 8.0) / 8.0, y = std::round(y * 8.0) / 8.0;
        points.push_back(at(x, y, round % 2 == 0 ? 1.0 : 1.0 + random()));
      }
    }
    std::vector<Triangle> triangles;
    for (Index j = 0; j + 1 < n; ++j) {
      for (Index i = 0; i + 1 < n; ++i) {
        const Index a = j * n + i;
        triangles.push_back({a, a + n, a + 1});
        triangles.push_back({a + 1, a + n, a + n + 1});
      }
    }
    std::vector<int> times(kTileSize * kTileSize * 4, 0);
    for (const Triangle& t : triangles) {
      const TileSamples tile = draw_one_tile({t}, points, 4);
      for (std::size_t s = 0; s < times.size(); ++s) times[s] += tile.triangle[s] == 0 ? 1 : 0;
    }
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), static_cast<std::ptrdiff_t>(times.size())) << round;
  }
}

TEST(DrawTile, ShowsTheNearerTriangleWhateverTheOrder) {
  const std::vector<ScreenPoint> points = {at(0, 0, 2), at(60, 0, 2), at(0, 60, 2),
                                           at(0, 0, 1), at(60, 0, 1), at(0, 60, 1)};
  EXPECT_EQ(draw_one_tile({{0, 1, 2}, {3, 4, 5}}, points, 1).triangle[0], 1u);
  EXPECT_EQ(draw_one_tile({{3, 4, 5}, {0, 1, 2}}, points, 1).triangle[0], 0u);
}

TEST(DrawTile, DrawsWhatLiesBeforeTheEyeOfATriangleThatReachesBehindIt) {
  const TileSamples tile = draw_one_tile({{0, 1, 2}}, {at(16, 40, 1), at(-40, 16, 1), {-16.0, -90.0, -1.0}}, 1);
  const auto seen = std::count(tile.triangle.begin(), tile.triangle.end(), Index{0});
  EXPECT_GT(seen, 0);
  for (const float inverse_depth : tile.inverse_depth) EXPECT_GE(inverse_depth, 0.0f);
}

TEST(DrawTile, LeavesOutTrianglesWithoutAreaOrWithoutNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const std::vector<ScreenPoint> points = {at(1, 1, 1), at(20, 20, 1), at(30, 30, 1),
                                           {nan, 1, 1}, {inf, 5, 1},   {5, inf, 1}};
  const TileSamples tile = draw_one_tile({{0, 1, 2}, {0, 0, 1}, {0, 1, 3}, {0, 4, 5}, {3, 3, 3}}, points, 4);
  EXPECT_EQ(std::count(tile.triangle.begin(), tile.triangle.end(), kNone),
            static_cast<std::ptrdiff_t>(tile.triangle.size()));
}

TEST(EdgeFunctions, TellFrontFromBack) {
  // Counter-clockwise in a picture whose y points downwards.
  EXPECT_TRUE(edge_functions(at(0, 10, 1), at(10, 10, 1), at(0, 0, 1)).front);
  EXPECT_FALSE(edge_functions(at(0, 10, 1), at(0, 0, 1), at(10, 10, 1)).front);
}

TEST(BinBoxes, PutsABoxIntoEveryTileThatItTouches) {
  const std::vector<PixelBox> boxes = {{0, 0, 1, 1}, {31, 0, 33, 32}, {5, 5, 5, 9}, {0, 0, 70, 40}};
  const TileBins bins = bin_boxes(boxes, 70, 40);
  EXPECT_EQ(bins.columns, 3);
  EXPECT_EQ(bins.rows, 2);
  const auto items = [&](std::size_t tile) {
    const auto some = items_of(bins, tile);
    return std::vector<Index>(some.begin(), some.end());
  };
  EXPECT_EQ(items(0), (std::vector<Index>{0, 1, 3}));
  EXPECT_EQ(items(1), (std::vector<Index>{1, 3}));
  for (std::size_t tile = 2; tile < 6; ++tile) EXPECT_EQ(items(tile), std::vector<Index>{3});
}

}  // namespace
}  // namespace limber::eval
