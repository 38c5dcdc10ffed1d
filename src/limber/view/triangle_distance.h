// SPDX-License-Identifier: Apache-2.0
// How far a point is from a triangle, in the precision of floats.
// Part of the player: standard library only.
#pragma once

#include <algorithm>
#include <limits>

#include "limber/base/vec.h"

namespace limber {

inline float squared_distance_to_segment(const Vec3f& p, const Vec3f& a, const Vec3f& b) {
  const Vec3f ab = b - a, ap = p - a;
  const float along = dot(ap, ab), whole = squared_length(ab);
  const float share = along > 0 ? std::min(along / std::max(whole, std::numeric_limits<float>::min()), 1.0f) : 0.0f;
  return squared_length(ap - ab * share);
}

// To the plane where the point lies above the triangle, and otherwise to the sides; to those too where the normal is
// mostly rounding. Never less than the distance but by rounding.
inline float squared_distance_to_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f ab = b - a, ac = c - a, ap = p - a;
  const Vec3f normal = cross(ab, ac);
  const float whole = squared_length(normal);
  const float along_ac = dot(cross(ab, ap), normal), along_ab = dot(cross(ap, ac), normal);
  const bool is_above = (along_ab >= 0) & (along_ac >= 0) & (along_ab + along_ac <= whole);
  if (is_above && whole > 1e-8f * squared_length(ab) * squared_length(ac)) {
    const float height = dot(ap, normal);
    return height * height / whole;
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

}  // namespace limber
