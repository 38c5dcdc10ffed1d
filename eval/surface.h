// SPDX-License-Identifier: Apache-2.0
// A surface to be measured: triangles, and where their corners lie in one frame.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber::eval {

// Refers, does not own. Every corner is less than positions.size(); positions are finite. Vertices that no
// triangle uses are not part of the surface: no measure looks at them.
struct Surface {
  std::span<const Triangle> triangles;
  std::span<const Vec3f> positions;
};

// Position of corner k of triangle t.
inline Vec3d corner(const Surface& surface, std::size_t t, std::size_t k) {
  return Vec3d(surface.positions[surface.triangles[t][k]]);
}

// Twice the area of triangle t as a vector along its normal; zero where the triangle is degenerate.
inline Vec3d area_vector(const Surface& surface, std::size_t t) {
  const Vec3d a = corner(surface, t, 0);
  return cross(corner(surface, t, 1) - a, corner(surface, t, 2) - a);
}

// The point of triangle t with the given barycentric coordinates (sum 1). Written as a step from the first corner, so
// that the rounding error is that of the triangle's size wherever the triangle's corners are exact.
inline Vec3d point_at(const Surface& surface, std::size_t t, const std::array<double, 3>& barycentric) {
  const Vec3d a = corner(surface, t, 0);
  return a + ((corner(surface, t, 1) - a) * barycentric[1] + (corner(surface, t, 2) - a) * barycentric[2]);
}

// The box around the triangles (vertices without a triangle do not count).
inline Box bounding_box(const Surface& surface) {
  Box box;
  for (const Triangle& triangle : surface.triangles) {
    for (const Index vertex : triangle) box.add(Vec3d(surface.positions[vertex]));
  }
  return box;
}

// The vertices that a triangle uses.
inline Index used_vertex_count(const Surface& surface) {
  std::vector<bool> used(surface.positions.size(), false);
  Index count = 0;
  for (const Triangle& triangle : surface.triangles) {
    for (const Index vertex : triangle) {
      if (!used[vertex]) ++count;
      used[vertex] = true;
    }
  }
  return count;
}

}  // namespace limber::eval
