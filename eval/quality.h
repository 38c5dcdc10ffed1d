// SPDX-License-Identifier: Apache-2.0
// The triangles of an approximation by themselves: do they face the right way, and are they well shaped?
#pragma once

#include <cstddef>

#include "eval/closest_point.h"
#include "eval/surface.h"

namespace limber::eval {

struct Quality {
  std::size_t triangle_count = 0;
  std::size_t inverted = 0;    // turned by more than 90 degrees from the original
  std::size_t degenerate = 0;  // without a normal

  // The smallest angle of each triangle, in degrees, 0 to 60: over the triangles the least, the 5th percentile and the
  // mean. A degenerate triangle counts as 0.
  double least_angle = 0;
  double angle_percentile_5 = 0;
  double mean_angle = 0;
};

// A triangle counts as inverted where, at three or more of four points inside it, its normal is turned by more than 90
// degrees from the original's normal at the closest point. (One point would not do: on a thin sheet it may lie closer
// to the sheet's other side.) All values are 0 for an approximation without triangles. Precondition: `original_tree` is
// of `original`, which has a triangle.
Quality measure_quality(const Surface& original, const ClosestPointTree& original_tree, const Surface& approximation);

}  // namespace limber::eval
