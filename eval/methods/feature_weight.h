// SPDX-License-Identifier: Apache-2.0
// Zhang & Wu 2007, section 3.2: how much of a feature an edge is, in one frame.
#pragma once

#include <cstddef>
#include <span>

#include "eval/methods/method.h"
#include "limber/base/vec.h"
#include "limber/contract/surface.h"

namespace limber::eval {

// One frame of positions that are stored vertex by vertex.
class FramePositions {
 public:
  // positions: [vertex_count x frame_count]; frame < frame_count.
  FramePositions(std::span<const Vec3f> positions, std::size_t frame_count, std::size_t frame)
      : first_(positions.data() + frame), stride_(frame_count) {}

  Vec3d operator[](Index v) const { return static_cast<Vec3d>(first_[v * stride_]); }

 private:
  const Vec3f* first_;
  std::size_t stride_;
};

// The cosine of the angle at which the two triangles of an edge meet, whichever way they face: 1 where they are folded
// flat onto each other, -1 where they lie in a plane. Gives -1 where the edge has not two triangles with an area.
double meeting_cosine(Surface& surface, Index edge, const FramePositions& positions);

// The sum over the classes that a living edge is of:
//
//   class               is                                        as printed              by default
//   complex             on n >= 3 triangles                       n - 3                   n - 2
//   boundary            on 1 triangle                             max cos(theta)          (1 + max cos(theta)) / 2
//   boundary incident   not boundary; m boundary edges at it      m / 4                   the same
//   sharp               on 2 triangles that meet at an angle      sin(alpha)              cos(alpha / 2)
//                       alpha < the sharp angle
//   interior            none of these                             0                       0
//
// theta are its angles with the boundary edges at its ends, 180 degrees where the border is straight. By default the
// weight is 0 or more; docs/design.md, "Zhang and Wu", says why it is not as printed. sharp_cosine: of
// options.sharp_angle.
double feature_weight(Surface& surface, Index edge, const FramePositions& positions, double sharp_cosine, bool literal);

}  // namespace limber::eval
