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

#include <algorithm>
#include <array>
#include <cstdint>
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

// Larger motions count as this: sums stay within 64 bits.
inline constexpr std::int64_t kMostMotion = 1 << 30;

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
  // What a vertex tells those predicted from it.
  struct Trace {
    std::array<std::int32_t, 3> motion{};  // here * d - before * v, kept within +-kMostMotion
    std::uint64_t activity = 0;            // per axis, in kActivityBits each: the residual's magnitude there and on all
                                           // axes together; until the vertex is coded, of the frame before
  };

  // Three sums in one register: of at most kMostSources + 1 times 4 * kMostMagnitude.
  static constexpr unsigned kActivityBits = 21;

  template <class Coder, class Actual>
  Lattice code_vertex(Index place, Index source_count, const Lattice64& predicted, std::uint64_t activity, Coder& coder,
                      Actual& actual);

  const Traversal& traversal_;
  std::vector<Lattice> now_, before_;
  std::vector<Trace> traces_;
  std::vector<std::int16_t> weights_;  // [sources]
  bool weights_stale_ = true;
};

template <class Coder, class Actual>
void FinestPositions::code_key(Coder& coder, Actual&& actual) {
  weights_stale_ = true;
  const auto& begin = traversal_.sources.begin;
  for (Index i = 0; i < now_.size(); ++i) {
    Lattice64 predicted{};
    std::uint64_t activity = 0;
    for (Index s = begin[i]; s < begin[i + 1]; ++s) {
      const Index source = traversal_.sources.data[s];
      for (std::size_t k = 0; k < 3; ++k) predicted[k] += std::int64_t{now_[source][k]} * traversal_.key_weights[s];
      activity += traces_[source].activity;
    }
    for (std::size_t k = 0; k < 3; ++k) predicted[k] = (predicted[k] + (1 << (kWeightBits - 1))) >> kWeightBits;
    now_[i] = code_vertex(i, begin[i + 1] - begin[i], predicted, activity, coder, actual);
  }
  before_ = now_;
}

template <class Coder, class Actual>
void FinestPositions::code_step(const MotionFactors& factors, Coder& coder, Actual&& actual) {
  // As local variables: else what is written might be taken for them.
  const std::int16_t* const weights = motion_weights().data();
  const Index* const begin = traversal_.sources.begin.data();
  const Index* const sources = traversal_.sources.data.data();
  Trace* const traces = traces_.data();
  Lattice *const now = now_.data(), *const before = before_.data();
  const auto vertex_count = static_cast<Index>(now_.size());
  constexpr int kBits = kFactorBits + kWeightBits;
  const std::int64_t past = std::int64_t{factors.past} * (1 << kWeightBits);
  for (Index i = 0; i < vertex_count; ++i) {
    const Lattice last = now[i];
    Lattice64 velocity, predicted;
    for (std::size_t k = 0; k < 3; ++k) {
      velocity[k] = std::int64_t{last[k]} - before[i][k];
      predicted[k] = velocity[k] * past + (1 << (kBits - 1));
    }
    std::uint64_t activity = traces[i].activity;
    for (Index s = begin[i]; s < begin[i + 1]; ++s) {
      const Trace& source = traces[sources[s]];
      const std::int64_t weight = weights[s];
      for (std::size_t k = 0; k < 3; ++k) predicted[k] += source.motion[k] * weight;
      activity += source.activity;
    }
    for (std::size_t k = 0; k < 3; ++k) predicted[k] = last[k] + (predicted[k] >> kBits);
    const Lattice here = code_vertex(i, begin[i + 1] - begin[i], predicted, activity, coder, actual);
    now[i] = here;
    before[i] = last;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t motion = (std::int64_t{here[k]} - last[k]) * factors.here - velocity[k] * factors.before;
      traces[i].motion[k] = static_cast<std::int32_t>(std::clamp(motion, -kMostMotion, kMostMotion));
    }
  }
}

// How large a residual is to be expected: the mean of what was met at the sources and, at t-1, here.
template <class Coder, class Actual>
[[gnu::always_inline]] inline Lattice FinestPositions::code_vertex(Index place, Index source_count,
                                                                   const Lattice64& predicted, std::uint64_t activity,
                                                                   Coder& coder, Actual& actual) {
  const std::size_t weight = 4 * (source_count + 1);
  Lattice residuals{};
  if constexpr (Coder::kEncodes) {
    const Lattice target = actual(place);
    for (std::size_t k = 0; k < 3; ++k)
      residuals[k] =
          static_cast<std::int32_t>(static_cast<std::uint32_t>(target[k]) - static_cast<std::uint32_t>(predicted[k]));
  }
  constexpr std::uint64_t kMask = (1u << kActivityBits) - 1;
  residuals =
      coder.code({quadruple_mean(activity & kMask, weight), quadruple_mean((activity >> kActivityBits) & kMask, weight),
                  quadruple_mean(activity >> (2 * kActivityBits), weight)},
                 residuals);
  const std::uint64_t x = counted_magnitude(residuals[0]), y = counted_magnitude(residuals[1]),
                      z = counted_magnitude(residuals[2]);
  traces_[place].activity = (2 * x + y + z) | (x + 2 * y + z) << kActivityBits | (x + y + 2 * z) << (2 * kActivityBits);
  Lattice position;
  for (std::size_t k = 0; k < 3; ++k)
    position[k] =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(predicted[k]) + static_cast<std::uint32_t>(residuals[k]));
  return position;
}

}  // namespace limber
