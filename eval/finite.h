// SPDX-License-Identifier: Apache-2.0
// Which triangles can be drawn at all.
#pragma once

#include <span>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber::eval {

inline bool has_finite_corners(const Triangle& t, std::span<const Vec3f> positions) {
  return is_finite(positions[t[0]]) && is_finite(positions[t[1]]) && is_finite(positions[t[2]]);
}

}  // namespace limber::eval
