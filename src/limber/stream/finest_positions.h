// SPDX-License-Identifier: Apache-2.0
// Coding the positions of the finest vertices. Part of the player.
//
// A vertex is predicted from the frame before and from vertices coded before it (its sources, traversal.h):
//
//   x(t) ~ x + past * v + sum over sources j of w_j * (here * d_j - before * v_j)
//
// with x the position at t-1, v = x(t-1) - x(t-2), d_j = x_j(t) - x_j(t-1). The weights w_j write the vertex as an
// affine combination of its sources, as well as the geometry of the last key frame allows: then every motion that
// is locally affine is predicted exactly, in whatever pose. The three factors are the encoder's choice for each frame.
// At a key frame x(t) ~ sum of w_j x_j(t), with the weights of the traversal.
// All in integers: the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "limber/stream/quantizer.h"
#include "limber/stream/residuals.h"
#include "limber/stream/traversal.h"

namespace limber {

// In 1/64, each within +-kMostFactor.
struct MotionFactors {
  std::int16_t past = 0;
  std::int16_t here = 0;
  std::int16_t before = 0;

  friend bool operator==(const MotionFactors&, const MotionFactors&) = default;
};

inline constexpr int kFactorBits = 6;
inline constexpr int kMostFactor = 512;

using Lattice64 = std::array<std::int64_t, 3>;

// What coding a frame leaves for the next. Indexed by place.
class FinestPositions {
 public:
  // `traversal` must live as long as this.
  explicit FinestPositions(const Traversal& traversal);

  // Codes all vertices of a frame: `actual(place)` gives the position to write; not called when reading.
  template <class Coder, class Actual>
  void code_key(Coder& coder, Actual&& actual);
  template <class Coder, class Actual>
  void code_step(const MotionFactors& factors, Coder& coder, Actual&& actual);

  // After coding: [vertex_count] positions of this frame, and of the frame before (the same after a key).
  std::span<const Lattice> positions() const { return now_; }
  std::span<const Lattice> positions_before() const { return before_; }

  // The sources' weights for the frames after this key; call before using them.
  std::span<const std::int16_t> motion_weights();

 private:
  // The magnitudes of a vertex's residual on each axis, and their sum.
  struct Activity {
    std::array<std::uint32_t, 3> axis{};
    std::uint32_t sum = 0;
  };

  template <class Coder, class Actual>
  void code_vertex(Index place, const Lattice64& predicted, Coder& coder, Actual& actual);

  const Traversal& traversal_;
  std::vector<Lattice> now_, before_;
  std::vector<Activity> activity_;     // before a vertex is coded: of the frame before
  std::vector<Lattice64> motion_;      // here * d - before * v
  std::vector<std::int16_t> weights_;  // [sources]
  bool weights_stale_ = true;
};

template <class Coder, class Actual>
void FinestPositions::code_key(Coder& coder, Actual&& actual) {
  weights_stale_ = true;
  const auto& begin = traversal_.sources.begin;
  for (Index i = 0; i < now_.size(); ++i) {
    Lattice64 predicted{};
    for (Index s = begin[i]; s < begin[i + 1]; ++s) {
      const Lattice& source = now_[traversal_.sources.data[s]];
      for (std::size_t k = 0; k < 3; ++k) predicted[k] += std::int64_t{source[k]} * traversal_.key_weights[s];
    }
    for (std::size_t k = 0; k < 3; ++k) predicted[k] = (predicted[k] + (1 << (kWeightBits - 1))) >> kWeightBits;
    activity_[i] = {};
    code_vertex(i, predicted, coder, actual);
  }
  before_ = now_;
}

template <class Coder, class Actual>
void FinestPositions::code_step(const MotionFactors& factors, Coder& coder, Actual&& actual) {
  const auto weights = motion_weights();
  const auto& begin = traversal_.sources.begin;
  constexpr int kBits = kFactorBits + kWeightBits;
  for (Index i = 0; i < now_.size(); ++i) {
    const Lattice last = now_[i];
    Lattice64 velocity, predicted{};
    for (std::size_t k = 0; k < 3; ++k) velocity[k] = std::int64_t{last[k]} - before_[i][k];
    for (Index s = begin[i]; s < begin[i + 1]; ++s) {
      const Lattice64& source = motion_[traversal_.sources.data[s]];
      for (std::size_t k = 0; k < 3; ++k) predicted[k] += source[k] * weights[s];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t fine = predicted[k] + velocity[k] * factors.past * (1 << kWeightBits);
      predicted[k] = last[k] + ((fine + (1 << (kBits - 1))) >> kBits);
    }
    code_vertex(i, predicted, coder, actual);
    before_[i] = last;
    for (std::size_t k = 0; k < 3; ++k)
      motion_[i][k] = (std::int64_t{now_[i][k]} - last[k]) * factors.here - velocity[k] * factors.before;
  }
}

// How large a residual is to be expected: what was met at the sources, on the axes before, and here at t-1.
template <class Coder, class Actual>
void FinestPositions::code_vertex(Index place, const Lattice64& predicted, Coder& coder, Actual& actual) {
  std::array<std::uint64_t, 3> sum{};
  const Index first = traversal_.sources.begin[place], last = traversal_.sources.begin[place + 1];
  for (Index s = first; s < last; ++s) {
    const Activity& source = activity_[traversal_.sources.data[s]];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += std::uint64_t{source.sum} + source.axis[k];
  }
  const Activity own = activity_[place];
  const std::size_t weight = 4 * (last - first) + 4;
  std::uint64_t earlier_axes = 0;
  Activity activity;
  Lattice target{};
  if constexpr (Coder::kEncodes) target = actual(place);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint64_t expected = quadruple_mean(sum[k] + own.sum + own.axis[k] + 2 * earlier_axes, weight + 2 * k);
    const auto prediction = static_cast<std::uint32_t>(predicted[k]);
    std::int32_t residual = 0;
    if constexpr (Coder::kEncodes)
      residual = static_cast<std::int32_t>(static_cast<std::uint32_t>(target[k]) - prediction);
    residual = coder.code(k, expected, residual);
    now_[place][k] = static_cast<std::int32_t>(prediction + static_cast<std::uint32_t>(residual));
    const auto bits = static_cast<std::uint32_t>(residual);
    const std::uint32_t magnitude = (residual < 0 ? 0u - bits : bits) & 0x3fffffff;
    activity.axis[k] = magnitude;
    earlier_axes += magnitude;
  }
  activity.sum = activity.axis[0] + activity.axis[1] + activity.axis[2];
  activity_[place] = activity;
}

}  // namespace limber
