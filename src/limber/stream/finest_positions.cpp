// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/finest_positions.h"

#include <algorithm>
#include <bit>

namespace limber {
namespace {

constexpr std::int64_t kMostWeight = 512;

// Offsets of sources are scaled to this many units before weights are computed from them: then nothing below
// needs more than 60 bits.
constexpr std::int64_t kUnits = 90;

std::int64_t rounded_quotient(std::int64_t numerator, std::int64_t denominator) {
  const std::int64_t twice = 2 * numerator + denominator;
  std::int64_t quotient = twice / (2 * denominator);
  if (quotient * 2 * denominator > twice) --quotient;
  return quotient;
}

// The weights w, with sum 1, of smallest |x - sum w_j x_j|^2 + ridge * |w - 1/m|^2. With c the mean of the x_j and
// X_j = x_j - c they are w_j = 1/m + X_j . (X^T X + ridge)^-1 (x - c).
// `offsets`: x_j - x, [1, kMostSources]. `weights`: [offsets.size()], in 1/256, sum 256.
void affine_weights(std::span<Lattice64> offsets, std::span<std::int16_t> weights) {
  const auto m = static_cast<std::int64_t>(offsets.size());
  std::int64_t largest = 1;
  for (const Lattice64& offset : offsets)
    for (const std::int64_t o : offset) largest = std::max(largest, std::abs(o));
  const std::int64_t scale = (kUnits << 20) / largest;
  Lattice64 center{};
  for (Lattice64& offset : offsets) {
    for (std::size_t k = 0; k < 3; ++k) {
      offset[k] = (offset[k] * scale) >> 20;
      center[k] += offset[k];
    }
  }
  for (std::int64_t& c : center) c = rounded_quotient(c, m);

  std::int64_t a[6]{};  // xx yy zz xy xz yz of X^T X
  for (Lattice64& offset : offsets) {
    for (std::size_t k = 0; k < 3; ++k) offset[k] -= center[k];
    const auto [x, y, z] = offset;
    a[0] += x * x, a[1] += y * y, a[2] += z * z, a[3] += x * y, a[4] += x * z, a[5] += y * z;
  }
  const std::int64_t ridge = (a[0] + a[1] + a[2]) / 50 + 1;
  a[0] += ridge, a[1] += ridge, a[2] += ridge;

  const std::int64_t xx = a[1] * a[2] - a[5] * a[5], xy = a[4] * a[5] - a[3] * a[2], xz = a[3] * a[5] - a[4] * a[1];
  const std::int64_t yy = a[0] * a[2] - a[4] * a[4], yz = a[3] * a[4] - a[0] * a[5], zz = a[0] * a[1] - a[3] * a[3];
  std::int64_t determinant = a[0] * xx + a[3] * xy + a[4] * xz;  // >= ridge^3 > 0
  const auto [cx, cy, cz] = center;
  const Lattice64 z{-(xx * cx + xy * cy + xz * cz), -(xy * cx + yy * cy + yz * cz), -(xz * cx + yz * cy + zz * cz)};

  // One division for all: the determinant to 24 bits, its reciprocal to 40.
  const int shift = std::max(0, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(determinant))) - 24);
  determinant >>= shift;
  const std::int64_t reciprocal = (std::int64_t{1} << 40) / determinant;
  int rest = 1 << kWeightBits;
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    const std::int64_t product = offsets[j][0] * z[0] + offsets[j][1] * z[1] + offsets[j][2] * z[2];
    const std::int64_t slope = (((product << kWeightBits) >> shift) * reciprocal + (std::int64_t{1} << 39)) >> 40;
    const auto weight = static_cast<int>(std::clamp(slope + (1 << kWeightBits) / m, -kMostWeight, kMostWeight));
    weights[j] = static_cast<std::int16_t>(weight);
    rest -= weight;
  }
  weights[0] = static_cast<std::int16_t>(weights[0] + rest);
}

}  // namespace

FinestPositions::FinestPositions(const Traversal& traversal)
    : traversal_(traversal),
      now_(traversal.order.size()),
      before_(traversal.order.size()),
      traces_(traversal.order.size()),
      weights_(traversal.sources.data.size()) {}

std::span<const std::int16_t> FinestPositions::motion_weights() {
  if (!weights_stale_) return weights_;
  weights_stale_ = false;
  const auto& begin = traversal_.sources.begin;
  for (Index i = 0; i < now_.size(); ++i) {
    const Index count = begin[i + 1] - begin[i];
    if (count == 0) continue;
    std::array<Lattice64, kMostSources> offsets;
    for (Index j = 0; j < count; ++j) {
      const Lattice& source = now_[traversal_.sources.data[begin[i] + j]];
      for (std::size_t k = 0; k < 3; ++k) offsets[j][k] = std::int64_t{source[k]} - now_[i][k];
    }
    affine_weights(std::span(offsets).first(count), std::span(weights_).subspan(begin[i], count));
  }
  return weights_;
}

}  // namespace limber
