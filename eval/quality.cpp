// SPDX-License-Identifier: Apache-2.0
#include "eval/quality.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "eval/sum_pieces.h"

namespace limber::eval {
namespace {

constexpr std::array<std::array<double, 3>, 4> kPointsInside = {{
    {1.0 / 3, 1.0 / 3, 1.0 / 3},
    {2.0 / 3, 1.0 / 6, 1.0 / 6},
    {1.0 / 6, 2.0 / 3, 1.0 / 6},
    {1.0 / 6, 1.0 / 6, 2.0 / 3},
}};
constexpr int kInvertedPoints = 3;

bool is_inverted(const Surface& original, const ClosestPointTree& original_tree, const Surface& approximation,
                 std::size_t t) {
  const Vec3d normal = area_vector(approximation, t);
  int turned = 0;
  Index hint = kNone;
  for (const auto& barycentric : kPointsInside) {
    hint = original_tree.closest(point_at(approximation, t, barycentric), hint).triangle;
    turned += dot(normal, area_vector(original, hint)) < 0;
  }
  return turned >= kInvertedPoints;
}

// The angle between the two longer edges.
double smallest_angle(const Surface& surface, std::size_t t) {
  std::array<Vec3d, 3> edges;  // edge k leads from corner k + 1 to corner k + 2
  for (std::size_t k = 0; k < 3; ++k) edges[k] = corner(surface, t, (k + 2) % 3) - corner(surface, t, (k + 1) % 3);
  std::size_t shortest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (squared_length(edges[k]) < squared_length(edges[shortest])) shortest = k;
  }
  const Vec3d &one = edges[(shortest + 1) % 3], other = -edges[(shortest + 2) % 3];
  return std::atan2(length(cross(one, other)), dot(one, other)) * (180 / std::numbers::pi);
}

struct Counts {
  std::size_t inverted = 0;
  std::size_t degenerate = 0;
  double angles = 0;

  Counts& operator+=(const Counts& other) {
    inverted += other.inverted, degenerate += other.degenerate, angles += other.angles;
    return *this;
  }
};

}  // namespace

Quality measure_quality(const Surface& original, const ClosestPointTree& original_tree, const Surface& approximation) {
  assert(original_tree.triangle_count() == original.triangles.size() && !original.triangles.empty());
  const std::size_t triangle_count = approximation.triangles.size();
  if (triangle_count == 0) return {};

  std::vector<double> angles(triangle_count);
  const Counts counts = sum_pieces<Counts>(triangle_count, [&](std::size_t first, std::size_t count) {
    Counts part;
    for (std::size_t t = first; t < first + count; ++t) {
      if (area_vector(approximation, t) == Vec3d{}) {
        ++part.degenerate;
        continue;
      }
      part.inverted += is_inverted(original, original_tree, approximation, t);
      angles[t] = smallest_angle(approximation, t);
      part.angles += angles[t];
    }
    return part;
  });
  std::sort(angles.begin(), angles.end());
  return {.triangle_count = triangle_count,
          .inverted = counts.inverted,
          .degenerate = counts.degenerate,
          .least_angle = angles.front(),
          .angle_percentile_5 = angles[triangle_count / 20],
          .mean_angle = counts.angles / static_cast<double>(triangle_count)};
}

}  // namespace limber::eval
