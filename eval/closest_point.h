// SPDX-License-Identifier: Apache-2.0
// The closest point of a surface.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "eval/surface.h"

namespace limber::eval {

struct ClosestPoint {
  Vec3d point;
  double squared_distance = 0;
  Index triangle = kNone;
  std::array<double, 3> barycentric{};  // of `point` in `triangle`: at least 0, sum 1
};

// The closest point of one triangle, in double precision; `triangle` of the result is kNone. Degenerate triangles are
// the segments or the point that they look like.
ClosestPoint closest_point_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

// Answers closest-point queries on a surface. Embree finds the candidate triangles in single precision, around the
// centre of the surface and with a margin for its rounding; distances are computed in double precision from the
// positions as they were given. Where several triangles are equally close the first of them is the answer: results
// depend neither on the number of threads nor on the order of the queries.
class ClosestPointTree {
 public:
  ClosestPointTree();
  explicit ClosestPointTree(const Surface& surface) : ClosestPointTree() { rebuild(surface); }
  ClosestPointTree(ClosestPointTree&&) noexcept;
  ClosestPointTree& operator=(ClosestPointTree&&) noexcept;
  ~ClosestPointTree();

  // Takes a new surface, or the next frame of the same one, in place of the last. The surface is copied.
  void rebuild(const Surface& surface);

  Index triangle_count() const;

  // The closest point. A `hint`, the answer's triangle or one nearby (less than triangle_count(), or kNone), makes the
  // query faster and does not change its answer. Precondition: triangle_count() > 0, p finite. Safe to call from
  // several threads at once.
  ClosestPoint closest(const Vec3d& p, Index hint = kNone) const;

  // The same for many points, in parallel; fast where neighbours in the list are neighbours in space.
  // `closest_points` is [points.size()].
  void closest(std::span<const Vec3d> points, std::span<ClosestPoint> closest_points) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limber::eval
