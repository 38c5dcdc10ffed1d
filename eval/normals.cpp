// SPDX-License-Identifier: Apache-2.0
#include "eval/normals.h"

#include <cmath>
#include <cstddef>

namespace limber::eval {

std::vector<Vec3f> vertex_normals(std::span<const Triangle> triangles, std::span<const Vec3f> positions) {
  std::vector<Vec3d> sums(positions.size());
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d p(positions[t[k]]);
      const Vec3d a = Vec3d(positions[t[(k + 1) % 3]]) - p, b = Vec3d(positions[t[(k + 2) % 3]]) - p;
      const double weight = squared_length(a) * squared_length(b);
      const Vec3d normal = cross(a, b) * (1.0 / weight);
      if (weight > 0.0 && is_finite(normal)) sums[t[k]] += normal;
    }
  }
  std::vector<Vec3f> normals(positions.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double l = length(sums[i]);
    if (l > 0.0 && std::isfinite(l)) normals[i] = Vec3f(sums[i] * (1.0 / l));
  }
  return normals;
}

}  // namespace limber::eval
