// SPDX-License-Identifier: Apache-2.0
#include "eval/strokes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limber::eval {
namespace {

constexpr double kSoftness = 0.6;  // pixels

struct Side {
  Segment edge;
  bool front;

  friend bool operator<(const Side& a, const Side& b) { return a.edge != b.edge ? a.edge < b.edge : a.front < b.front; }
};

}  // namespace

std::vector<Segment> silhouette_edges(std::span<const Triangle> triangles, std::span<const ScreenPoint> points) {
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) {
    const EdgeFunctions e = edge_functions(points[t[0]], points[t[1]], points[t[2]]);
    if (!(e.det > 0.0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, e.front});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<Segment> edges;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
    const bool inside = end - i == 2 && sides[i].front == sides[i + 1].front;
    if (!inside) edges.push_back(sides[i].edge);
    i = end;
  }
  return edges;
}

float ink_share(double distance, double line_width) {
  return static_cast<float>(std::clamp((0.5 * line_width - distance) / kSoftness + 0.5, 0.0, 1.0));
}

void draw_strokes(std::span<const Segment> segments, std::span<const ScreenPoint> points, std::span<const Index> items,
                  const SamplePattern& pattern, double line_width, const TileSamples& tile, std::span<float> ink) {
  assert(ink.size() == tile.triangle.size());
  const double reach = 0.5 * (line_width + kSoftness);
  for (const Index item : items) {
    const ScreenPoint ends[2] = {points[segments[item][0]], points[segments[item][1]]};
    if (!(ends[0].w > 0.0 && ends[1].w > 0.0)) continue;
    const double ax = ends[0].x / ends[0].w, ay = ends[0].y / ends[0].w, a_near = 1.0 / ends[0].w;
    const double dx = ends[1].x / ends[1].w - ax, dy = ends[1].y / ends[1].w - ay, d_near = 1.0 / ends[1].w - a_near;
    const double square = dx * dx + dy * dy;
    const PixelBox box = pixel_box(ends, tile.pixels.x1, tile.pixels.y1, reach);
    for (int y = std::max(box.y0, tile.pixels.y0); y < box.y1; ++y) {
      for (int x = std::max(box.x0, tile.pixels.x0); x < box.x1; ++x) {
        const std::size_t first = tile.offset(x, y);
        for (int s = 0; s < pattern.count; ++s) {
          const double px = x + pattern.x[s] - ax, py = y + pattern.y[s] - ay;
          const double along = square > 0.0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0.0;
          const double qx = px - along * dx, qy = py - along * dy;
          const double distance = std::sqrt(qx * qx + qy * qy);
          if (distance >= reach) continue;
          const std::size_t sample = first + static_cast<std::size_t>(s);
          const double nearness = (a_near + along * d_near) * (1.0 + 2e-4);
          if (nearness < static_cast<double>(tile.inverse_depth[sample])) continue;
          ink[sample] = std::max(ink[sample], ink_share(distance, line_width));
        }
      }
    }
  }
}

}  // namespace limber::eval
