// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/fan.h"

#include <cassert>

namespace limber {
namespace {

// The squared sine of the angle at the node below which a triangle counts as a line.
constexpr float kLeastSine = 1e-8f;
// The squared sine of the angle between a triangle and the way from the node to a point above it: up to here no side of
// another triangle is looked at.
constexpr float kSteep = 0.05f;

}  // namespace

void Fan::grow() {
  blocks_.emplace_back();
  corners_.resize(8 * blocks_.size());
}

void Fan::prepare(Block& block) {
  const Float4 none = {}, one = none + 1;
  const Vector4 normal = crosses(block.a, block.b);
  const Float4 squared = dots(normal, normal);
  const Float4 least = kLeastSine * dots(block.a, block.a) * dots(block.b, block.b);
  const Float4 by_squared = squared > least ? one / squared : none;
  const auto scaled = [&](const Vector4& v) { return Vector4{v.x * by_squared, v.y * by_squared, v.z * by_squared}; };
  block.normal = normal;
  block.dual_a = scaled(crosses(block.b, normal)), block.dual_b = scaled(crosses(normal, block.a));
  block.limit = by_squared > 0 ? one : -one;
  block.by_squared = by_squared;
}

void Fan::finish() {
  for (unsigned i = 0; 4 * i < size_; ++i) prepare(blocks_[i]);
}

// The nearest triangle that the point is right above or below.
Fan::Found Fan::find_below(const Vector4& point) const {
  const Float4 far = Float4{} + 1e30f;
  Float4 least = far, at_a = {}, at_b = {};
  Int4 found = {};
  for (unsigned i = 0; 4 * i < size_; ++i) {
    const Block& block = blocks_[i];
    const Float4 a = dots(block.dual_a, point), b = dots(block.dual_b, point), h = dots(block.normal, point);
    const Int4 is_below = (a >= 0) & (b >= 0) & (a + b <= block.limit);
    const Float4 here = is_below ? h * h * block.by_squared : far;
    const Int4 is_less = here < least;
    least = is_less ? here : least;
    at_a = is_less ? a : at_a;
    at_b = is_less ? b : at_b;
    found = is_less ? Int4{} + static_cast<int>(i) : found;
  }
  unsigned lane = 0;
  for (unsigned k = 1; k < 4; ++k)
    if (least[k] < least[lane]) lane = k;
  return {least[lane] < far[0] ? 4 * static_cast<Index>(found[lane]) + lane : kNone, least[lane], at_a[lane],
          at_b[lane]};
}

Fan::Found Fan::find_on_sides(const Vector4& point) const {
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

Fan::Place Fan::closest(const Vec3f& p) const {
  assert(!empty());
  const Vector4 point{Float4{} + p.x, Float4{} + p.y, Float4{} + p.z};
  const float to_node = squared_length(p);
  const Found below = find_below(point);
  if (below.triangle == kNone || below.squared > kSteep * to_node) {
    const Found side = find_on_sides(point);
    if (below.triangle == kNone || to_node - side.squared < below.squared) {
      const Vec3f way = p - extract(blocks_[side.triangle / 4].a, side.triangle % 4) * side.at_a -
                        extract(blocks_[side.triangle / 4].b, side.triangle % 4) * side.at_b;
      const float squared = squared_length(way);
      return {corners_[2 * side.triangle],
              corners_[2 * side.triangle + 1],
              side.at_a,
              side.at_b,
              way,
              squared > 0 ? 1 / squared : 0,
              1};
    }
  }
  const Block& block = blocks_[below.triangle / 4];
  const unsigned lane = below.triangle % 4;
  const Vec3f normal = extract(block.normal, lane);
  const float by_squared = block.by_squared[lane];
  return {corners_[2 * below.triangle], corners_[2 * below.triangle + 1], below.at_a, below.at_b, normal, by_squared,
          dot(normal, p) * by_squared};
}

}  // namespace limber
