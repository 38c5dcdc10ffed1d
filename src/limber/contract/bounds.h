// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>

#include "limber/base/vec.h"

namespace limber {

// The bounding box of finite positions; empty without any.
inline Box bounds(std::span<const Vec3f> positions) {
  if (positions.empty()) return {};
  Vec3f low = positions[0], high = low;  // single precision and no call for each point, unlike Box::add
  for (const Vec3f& p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {static_cast<Vec3d>(low), static_cast<Vec3d>(high)};
}

}  // namespace limber
