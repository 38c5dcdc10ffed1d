// SPDX-License-Identifier: Apache-2.0
// Coding the positions of the nodes above the finest level. Part of the player.
//
// A node lies near the mean of its children, which are known by then, and how far from it changes little but for the
// turning of its surroundings:
//
//   x(t) ~ mean of the children's x(t) + R o(t-1),   o = x - mean of the children
//
// with the children as they are at each of the times, so that swaps are followed, and the rotation R of turns.h. At a
// key frame o = 0; in a lossless stream, whose integers are no coordinates, R = 1. A node without children is predicted
// where it was.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/hierarchy/hierarchy.h"
#include "limber/stream/finest_positions.h"
#include "limber/stream/turns.h"

namespace limber {

// What coding a frame leaves for the next. Indexed by node less the number of finest vertices.
class CoarserPositions {
 public:
  CoarserPositions(std::span<const Index> level_begin, bool turning);

  // Codes all nodes above the finest of a frame, level by level, after the finest. `parent` [node_count];
  // `actual(node, predicted)` gives the position to write; not called when reading.
  template <class Coder, class Actual>
  void code(bool key, std::span<const Index> parent, const Traversal& traversal, const FinestPositions& finest,
            Coder& coder, Actual&& actual);

  std::span<const Lattice> positions() const { return now_; }

 private:
  Lattice64 turned(std::span<const Index> parent, Index node, const Lattice64& offset) const;

  struct Children {
    Lattice64 sum{};
    std::int64_t count = 0;

    void add(const Lattice& position) {
      for (std::size_t k = 0; k < 3; ++k) sum[k] += position[k];
      ++count;
    }

    // Rounded towards 0. Quotients of doubles, which take less time, do so too where the sums are whole numbers of at
    // most 52 bits: such a quotient that is no whole number is further from the next than it is rounded.
    Lattice64 mean() const {
      constexpr std::int64_t kMostInDoubles = 1 << 20;
      if (count > kMostInDoubles) [[unlikely]]
        return {sum[0] / count, sum[1] / count, sum[2] / count};
      const auto divisor = static_cast<double>(count);
      const auto quotient = [&](std::int64_t s) { return static_cast<std::int64_t>(static_cast<double>(s) / divisor); };
      return {quotient(sum[0]), quotient(sum[1]), quotient(sum[2])};
    }
  };
  struct Node {
    Lattice64 offset{};
    std::uint32_t activity = 0;
  };

  std::span<const Index> level_begin_;
  bool turning_;
  Turns turns_;
  std::vector<Lattice> now_;
  std::vector<Children> children_;
  std::vector<Node> nodes_;
};

inline Lattice64 CoarserPositions::turned(std::span<const Index> parent, Index node, const Lattice64& offset) const {
  const auto [x, y, z] = turns_.turned(parent, node, {double(offset[0]), double(offset[1]), double(offset[2])});
  // floor(a + 0.5), without a call.
  const auto nearest = [](double a) {
    const auto truncated = static_cast<std::int64_t>(a + 0.5);
    return truncated - (static_cast<double>(truncated) > a + 0.5);
  };
  return {nearest(x), nearest(y), nearest(z)};
}

template <class Coder, class Actual>
void CoarserPositions::code(bool key, std::span<const Index> parent, const Traversal& traversal,
                            const FinestPositions& finest, Coder& coder, Actual&& actual) {
  if (now_.empty()) return;
  const Index vertex_count = level_begin_[1];
  std::fill(children_.begin(), children_.end(), Children{});
  for (Index place = 0; place < vertex_count; ++place)
    children_[parent[traversal.order[place]] - vertex_count].add(finest.positions()[place]);
  const bool turning = turning_ && !key;
  if (turning) turns_.measure(parent, traversal, finest.positions_before(), finest.positions());

  std::uint32_t neighborhood = 0;  // four times a running mean of the magnitudes
  for (Index i = 0; i < now_.size(); ++i) {
    Node& node = nodes_[i];
    if (key) {
      node = {};
      now_[i] = {};
    }
    const Children& children = children_[i];
    const Lattice64 offset = turning ? turned(parent, vertex_count + i, node.offset) : node.offset;
    Lattice64 mean, predicted;
    if (children.count > 0) {
      mean = children.mean();
      for (std::size_t k = 0; k < 3; ++k) predicted[k] = mean[k] + offset[k];
    } else {
      mean = predicted = {now_[i][0], now_[i][1], now_[i][2]};
    }
    Lattice target{};
    if constexpr (Coder::kEncodes) target = actual(vertex_count + i, predicted);
    // Twelfths: the running mean holds four nodes' sums of three axes.
    const std::uint32_t expected =
        key ? quadruple_mean(neighborhood, 12)
            : quadruple_mean(std::uint64_t{neighborhood} + 4 * std::uint64_t{node.activity}, 24);
    Lattice residuals{};
    if constexpr (Coder::kEncodes)
      for (std::size_t k = 0; k < 3; ++k)
        residuals[k] =
            static_cast<std::int32_t>(static_cast<std::uint32_t>(target[k]) - static_cast<std::uint32_t>(predicted[k]));
    residuals = coder.code({expected, expected, expected}, residuals);
    node.activity = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      now_[i][k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(predicted[k]) +
                                             static_cast<std::uint32_t>(residuals[k]));
      node.activity += counted_magnitude(residuals[k]);
    }
    neighborhood += node.activity - neighborhood / 4;
    node.offset = {now_[i][0] - mean[0], now_[i][1] - mean[1], now_[i][2] - mean[2]};
    if (parent[vertex_count + i] != kNone) children_[parent[vertex_count + i] - vertex_count].add(now_[i]);
  }
}

}  // namespace limber
