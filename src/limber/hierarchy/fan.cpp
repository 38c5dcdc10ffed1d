// SPDX-License-Identifier: Apache-2.0
// Four points are asked for at a time. Each triangle is looked at once for all of them: above which one is a point, and
// how far? Few points need more than that; these look at the sides, four triangles at a time.
#include "limber/hierarchy/fan.h"

#include <cassert>

namespace limber {
namespace {

// The squared sine of the angle at the node below which a triangle counts as a line.
constexpr float kLeastSine = 1e-8f;
// The squared sine of the angle between a triangle and the way from the node to a point above it: up to here no side of
// another triangle is looked at.
constexpr float kSteep = 0.05f;
constexpr float kFar = 1e30f;  // squared

Float4 dots(const Vector4& u, const Vector4& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }

Vector4 crosses(const Vector4& u, const Vector4& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

template <unsigned kLane>
Float4 spread(Float4 v) {
  return __builtin_shufflevector(v, v, kLane, kLane, kLane, kLane);
}

template <unsigned kLane>
Vector4 spread(const Vector4& v) {
  return {spread<kLane>(v.x), spread<kLane>(v.y), spread<kLane>(v.z)};
}

Vec3f extract(const Vector4& v, unsigned lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }

// a / b between 0 and 1; 0 where b is none.
Float4 clamped_ratio(Float4 a, Float4 b) {
  const Float4 ratio = ((a > 0) & (b > 0)) ? a / b : Float4{};
  return ratio < 1 ? ratio : Float4{} + 1;
}

}  // namespace

void Fan::grow() {
  blocks_.emplace_back();
  facets_.resize(4 * blocks_.size());
  corners_.resize(8 * blocks_.size());
}

void Fan::prepare(unsigned i) {
  const auto& [a, b] = blocks_[i];
  const Float4 none = {}, one = none + 1;
  const Vector4 normal = crosses(a, b);
  const Float4 squared = dots(normal, normal);
  const Float4 least = kLeastSine * dots(a, a) * dots(b, b);
  const Float4 by_squared = squared > least ? one / squared : none;
  const auto scaled = [&](const Vector4& v) { return Vector4{v.x * by_squared, v.y * by_squared, v.z * by_squared}; };
  const Vector4 dual_a = scaled(crosses(b, normal)), dual_b = scaled(crosses(normal, a));
  const Float4 limit = by_squared > 0 ? one : -one;
  Facet* const facets = &facets_[4 * i];
  const auto store = [&]<unsigned kLane>() {
    facets[kLane] = {spread<kLane>(normal), spread<kLane>(dual_a), spread<kLane>(dual_b), spread<kLane>(limit),
                     spread<kLane>(by_squared)};
  };
  store.operator()<0>(), store.operator()<1>(), store.operator()<2>(), store.operator()<3>();
}

void Fan::finish() {
  for (unsigned i = 0; 4 * i < size_; ++i) prepare(i);
}

// The nearest one on a side, to one point in all lanes.
Fan::Side Fan::find_on_sides(const Vector4& point) const {
  Float4 most = Float4{} - 1, at_a = {}, at_b = {};
  Int4 found = {};
  for (unsigned i = 0; 4 * i < size_; ++i) {
    const Block& block = blocks_[i];
    const Float4 aa = dots(block.a, block.a), ab = dots(block.a, block.b), bb = dots(block.b, block.b);
    const Float4 cc = aa - 2 * ab + bb;
    const Float4 a = dots(block.a, point), b = dots(block.b, point), c = b - a + aa - ab;
    const Float4 s = clamped_ratio(a, aa), t = clamped_ratio(b, bb), u = clamped_ratio(c, cc);
    const Float4 on_a = s * (2 * a - s * aa), on_b = t * (2 * b - t * bb);
    const Float4 on_c = 2 * a - aa + u * (2 * c - u * cc);
    const Int4 is_on_b = on_b > on_a;
    const Float4 on_ab = is_on_b ? on_b : on_a;
    const Int4 is_on_c = on_c > on_ab;
    const Float4 here = is_on_c ? on_c : on_ab;
    const Int4 is_more = here > most;
    most = is_more ? here : most;
    at_a = is_more ? (is_on_c ? 1 - u : is_on_b ? Float4{} : s) : at_a;
    at_b = is_more ? (is_on_c ? u : is_on_b ? t : Float4{}) : at_b;
    found = is_more ? Int4{} + static_cast<int>(i) : found;
  }
  unsigned lane = 0;
  for (unsigned k = 1; k < 4; ++k)
    if (most[k] > most[lane]) lane = k;
  return {4 * static_cast<Index>(found[lane]) + lane, most[lane], at_a[lane], at_b[lane]};
}

// If that is nearer than what is right below, at the squared distance `below`.
void Fan::move_to_side(Places& places, unsigned lane, const Vector4& points, float below) const {
  const Vec3f p = extract(points, lane);
  const Side side = find_on_sides({Float4{} + p.x, Float4{} + p.y, Float4{} + p.z});
  if (below < kFar && squared_length(p) - side.gain >= below) return;
  const Block& block = blocks_[side.triangle / 4];
  const Vec3f way =
      p - extract(block.a, side.triangle % 4) * side.at_a - extract(block.b, side.triangle % 4) * side.at_b;
  const float squared = squared_length(way);
  places.a[lane] = corners_[2 * side.triangle], places.b[lane] = corners_[2 * side.triangle + 1];
  places.at_a[lane] = side.at_a, places.at_b[lane] = side.at_b;
  places.direction.x[lane] = way.x, places.direction.y[lane] = way.y, places.direction.z[lane] = way.z;
  places.by_squared[lane] = squared > 0 ? 1 / squared : 0;
  places.steps[lane] = 1;
}

Fan::Places Fan::closest(const Vector4& points) const {
  assert(!empty());
  Float4 least = Float4{} + kFar, at_a = {}, at_b = {};
  Int4 found = {};
  for (unsigned i = 0; i < size_; ++i) {
    const Facet& facet = facets_[i];
    const Float4 a = dots(facet.dual_a, points), b = dots(facet.dual_b, points), h = dots(facet.normal, points);
    const Float4 here = h * h * facet.by_squared;
    const Int4 is_nearer = (a >= 0) & (b >= 0) & (a + b <= facet.limit) & (here < least);
    least = is_nearer ? here : least;
    at_a = is_nearer ? a : at_a;
    at_b = is_nearer ? b : at_b;
    found = is_nearer ? Int4{} + static_cast<int>(i) : found;
  }
  Places places;
  places.at_a = at_a, places.at_b = at_b;
  for (unsigned lane = 0; lane < 4; ++lane) {
    const auto i = static_cast<Index>(found[lane]);
    const Facet& facet = facets_[i];
    places.a[lane] = corners_[2 * i], places.b[lane] = corners_[2 * i + 1];
    places.direction.x[lane] = facet.normal.x[0];
    places.direction.y[lane] = facet.normal.y[0];
    places.direction.z[lane] = facet.normal.z[0];
    places.by_squared[lane] = facet.by_squared[0];
  }
  places.steps = dots(places.direction, points) * places.by_squared;
  const Int4 is_steep = least > kSteep * dots(points, points);
  for (unsigned lane = 0; lane < 4; ++lane)
    if (is_steep[lane]) move_to_side(places, lane, points, least[lane]);
  return places;
}

}  // namespace limber
