// SPDX-License-Identifier: Apache-2.0
// Which way pieces of a surface face, and triangles that face the other way.
#pragma once

#include "limber/base/vec.h"

namespace limber {

// Of a piece of surface. They add.
struct Facing {
  Vec3d vector;     // the sum of area x normal
  double area = 0;  // the sum of areas: no less than the length of that

  Facing& operator+=(const Facing& o) {
    vector += o.vector, area += o.area;
    return *this;
  }
  Facing& operator-=(const Facing& o) {
    vector -= o.vector, area -= o.area;
    return *this;
  }
};

// Whether the triangle abc faces away from the surface that it stands for. On thin sheets and sharp edges that faces
// several ways, and says nothing: false.
inline bool is_turned_over(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Facing& surface) {
  constexpr double kOneWay = 0.7;  // the least length of the mean normal of a surface that faces one way
  return dot(cross(b - a, c - a), surface.vector) < 0 &&
         squared_length(surface.vector) >= kOneWay * kOneWay * surface.area * surface.area;
}

}  // namespace limber
