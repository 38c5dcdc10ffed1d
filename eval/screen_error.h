// SPDX-License-Identifier: Apache-2.0
// How far what is drawn is from its original, in pixels of a picture: the measure that cuts by a view are held to.
#pragma once

#include <cstddef>
#include <cstdint>

#include "eval/closest_point.h"
#include "eval/surface.h"
#include "limber/view/view.h"

namespace limber::eval {

// The largest distance of the points that lie in the picture, hidden or not, to the closest point of the other surface;
// each in pixels: times the pixels that a length of 1 across the line of sight takes at the depth of the point.
struct ScreenError {
  double to_drawn = 0;          // from the vertices and samples of the original
  double to_original = 0;       // from the vertices, middles of sides, and samples of what is drawn
  std::size_t point_count = 0;  // in the picture

  double largest() const { return to_drawn > to_original ? to_drawn : to_original; }
};

// `sample_count` samples on each surface, uniform by area, before those out of the picture are dropped.
// Preconditions: both surfaces have a triangle; the trees are theirs; view has a camera.
ScreenError measure_screen_error(const Surface& original, const ClosestPointTree& original_tree, const Surface& drawn,
                                 const ClosestPointTree& drawn_tree, const View& view, std::size_t sample_count);

// A camera that sees at least a part of the box, from anywhere around: .3 to 3 diagonals away, towards anything within
// half a diagonal of the middle, with 20 to 60 degrees; a picture of 1280 x 960. The same for the same seed.
View random_view(const Box& box, std::uint64_t seed);

// From 0.5 to 4, as evenly spread as its logarithm is.
double random_pixels(std::uint64_t seed);

}  // namespace limber::eval
