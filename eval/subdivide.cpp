// SPDX-License-Identifier: Apache-2.0
#include "eval/subdivide.h"

#include <cassert>

namespace limber::eval {

//   row 0      0            vertex of row r and place i in it: r (r + 1) / 2 + i
//   row 1     1 2
//   row 2    3 4 5
Subdivided subdivide(const Surface& surface, std::span<const Vec3f> normals, Index steps) {
  assert(steps >= 1 && normals.size() == surface.positions.size());
  Subdivided out;
  const std::size_t vertices_each = std::size_t{steps + 1} * (steps + 2) / 2;
  out.triangles.reserve(surface.triangles.size() * steps * steps);
  out.positions.reserve(surface.triangles.size() * vertices_each);
  out.normals.reserve(surface.triangles.size() * vertices_each);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& corners = surface.triangles[t];
    const auto first = static_cast<Index>(out.positions.size());
    for (Index row = 0; row <= steps; ++row) {
      for (Index i = 0; i <= row; ++i) {
        const double b = static_cast<double>(row - i) / steps, c = static_cast<double>(i) / steps;
        const auto at = [&](Index k) { return Vec3d(normals[corners[k]]); };
        out.positions.push_back(Vec3f(point_at(surface, t, {1 - b - c, b, c})));
        out.normals.push_back(Vec3f(at(0) * (1 - b - c) + at(1) * b + at(2) * c));
      }
    }
    for (Index row = 0; row < steps; ++row) {
      const Index above = first + row * (row + 1) / 2, below = above + row + 1;
      for (Index i = 0; i <= row; ++i) {
        out.triangles.push_back({above + i, below + i, below + i + 1});
        if (i < row) out.triangles.push_back({above + i, below + i + 1, above + i + 1});
      }
    }
  }
  return out;
}

}  // namespace limber::eval
