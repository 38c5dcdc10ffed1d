// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/turns.h"

#include <algorithm>
#include <cmath>

namespace limber {
namespace {

constexpr double kLeastCount = 3;

// Vertices per node, in the mean, of the lowest level that is measured.
constexpr Index kMeasuredSize = 6;

Index lowest_measured(std::span<const Index> level_begin) {
  const auto top = static_cast<Index>(level_begin.size()) - 2;
  Index level = std::min<Index>(1, top);
  while (level < top && level_begin[1] / kMeasuredSize < level_begin[level + 1] - level_begin[level]) ++level;
  return level;
}

// Where in the moments.
enum : std::size_t { kBefore = 0, kNow = 3, kTwist = 6, kSquares = 9, kCount = 15 };

Vec3d coordinates(const Lattice& at) { return {double(at[0]), double(at[1]), double(at[2])}; }

template <std::size_t kSize>
Vec3d vector(const std::array<double, kSize>& from, std::size_t at) {
  return {from[at], from[at + 1], from[at + 2]};
}

template <std::size_t kSize>
void add(std::array<double, kSize>& to, const std::array<double, kSize>& more) {
  for (std::size_t i = 0; i < kSize; ++i) to[i] += more[i];
}

}  // namespace

Turns::Turns(std::span<const Index> level_begin)
    : level_(lowest_measured(level_begin)),
      first_(level_begin[level_]),
      moments_(level_begin.back() - first_),
      turns_(moments_.size()) {}

// A little of the trace is added to the diagonal, for clusters on a line, and a lattice step for every vertex: what is
// smaller than the rounding of the positions says nothing.
Turns::Turn Turns::turn(const Moments& m) {
  const Vec3d before = vector(m, kBefore), now = vector(m, kNow);
  const Vec3d mean = before * (1.0 / m[kCount]);
  const double xx = m[kSquares] - before.x * mean.x, yy = m[kSquares + 3] - before.y * mean.y;
  const double zz = m[kSquares + 5] - before.z * mean.z, xy = m[kSquares + 1] - before.x * mean.y;
  const double xz = m[kSquares + 2] - before.x * mean.z, yz = m[kSquares + 4] - before.y * mean.z;
  const Vec3d twist = vector(m, kTwist) - cross(mean, now);
  const double ridge = 0.01 * (xx + yy + zz) + m[kCount];
  // The system: a symmetric matrix with p, q, r on its diagonal and -xy, -xz, -yz beside it; solved by its adjugate.
  const double p = yy + zz + ridge, q = xx + zz + ridge, r = xx + yy + ridge;
  const double axx = q * r - yz * yz, axy = xy * r + xz * yz, axz = xy * yz + xz * q;
  const double ayy = p * r - xz * xz, ayz = p * yz + xy * xz, azz = p * q - xy * xy;
  const double determinant = p * axx - xy * axy - xz * axz;
  const double reciprocal = 1.0 / determinant;
  const Vec3d w{(axx * twist.x + axy * twist.y + axz * twist.z) * reciprocal,
                (axy * twist.x + ayy * twist.y + ayz * twist.z) * reciprocal,
                (axz * twist.x + ayz * twist.y + azz * twist.z) * reciprocal};
  const double square = squared_length(w);
  if (!(square <= 1.0)) return {};  // more than a right angle, or no number
  const Vec3d half = w * (1.0 / (1.0 + std::sqrt(1.0 - square)));
  return {half, 2.0 / (1.0 + squared_length(half))};
}

void Turns::measure(std::span<const Index> parent, const Traversal& traversal, std::span<const Lattice> before,
                    std::span<const Lattice> now) {
  std::fill(moments_.begin(), moments_.end(), Moments{});
  for (Index place = 0; place < now.size(); ++place) {
    Index node = traversal.order[place];
    for (Index level = 0; level < level_; ++level) node = parent[node];
    const Vec3d a = coordinates(before[place]), b = coordinates(now[place]), c = cross(a, b);
    add(moments_[node - first_], {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, a.x * a.x, a.x * a.y, a.x * a.z,
                                  a.y * a.y, a.y * a.z, a.z * a.z, 1.0});
  }
  const auto parent_of = [&](Index i) { return parent[first_ + i]; };
  const auto count = static_cast<Index>(moments_.size());
  for (Index i = 0; i < count; ++i)
    if (parent_of(i) != kNone) add(moments_[parent_of(i) - first_], moments_[i]);
  for (Index i = count; i-- > 0;) {
    if (moments_[i][kCount] >= kLeastCount) {
      turns_[i] = turn(moments_[i]);
    } else {
      turns_[i] = parent_of(i) == kNone ? Turn{} : turns_[parent_of(i) - first_];
    }
  }
}

}  // namespace limber
