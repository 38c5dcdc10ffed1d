// SPDX-License-Identifier: Apache-2.0
// Where the vertex that an edge is contracted to goes, and what that costs: volume and boundary optimisation of
// Lindstrom & Turk 1998, section 4. Differences: docs/design.md, "Volume placement".
//
// A star is the surface around a vertex. Seen from its vertex it is a pure quadratic form, because all of its planes
// pass through the vertex: nothing is lost to cancellation, however small the star is.
#pragma once

#include <algorithm>

#include "limber/base/vec.h"
#include "limber/contract/symmetric_matrix.h"

namespace limber {

// A triangle's unit normal, 0 where it has no area, and twice its area.
struct Facet {
  Vec3d normal;
  double area = 0;

  static Facet of(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d n = cross(b - a, c - a);
    const double area = length(n);
    return {area > 0 ? n * (1 / area) : Vec3d{}, area};
  }
};

// The squared volume between the triangle and x, divided by the area: what the triangle adds to x'Sx for its corners.
inline void add_facet(SymmetricMatrix& star, const Facet& facet) { star.add_along(facet.normal, facet.area); }

// How far an edge between two triangles is held as if it were a border: from nothing where the surface turns by 60
// degrees to 1 where it turns back on itself, as on the rim of a thin sheet, which loses no volume by retracting.
inline double rim_weight(const Facet& a, const Facet& b) { return std::max(0.5 - dot(a.normal, b.normal), 0.0) / 1.5; }

// That of an edge that is on one triangle alone, or on more than two.
inline constexpr double kBorderWeight = 2;

// The squared area between the edge and x: what the edge adds to x'Sx for its ends.
inline void add_rim(SymmetricMatrix& star, const Vec3d& edge, double weight) { star.add_across(edge, weight); }

// A little of the squared distance to the vertex itself, for regions that are flat. The last thing added to a star.
inline void add_center(SymmetricMatrix& star) { star.add_diagonal(1e-6 * star.trace()); }

struct VolumePlacement {
  Vec3d point;      // seen from the middle of the edge
  double cost = 0;  // >= 0
};

// The least of what the star of the first end, that of the second, which lies `edge` away from it, and the opposite of
// what they share add up to.
inline VolumePlacement place(const SymmetricMatrix& first, const SymmetricMatrix& second, const SymmetricMatrix& shared,
                             const Vec3d& edge) {
  // (y + h)'A(y + h) + (y - h)'B(y - h) - y'Sy  =  y'(A + B - S)y - 2 y.(B - A)h + h'(A + B)h,  as S h = 0
  const Vec3d half = edge * 0.5, of_first = first * half, of_second = second * half;
  const Vec3d pull = of_second - of_first;
  const Vec3d point = solve(first + second - shared, pull);
  return {point, std::max(dot(half, of_first + of_second) - dot(pull, point), 0.0)};
}

}  // namespace limber
