// SPDX-License-Identifier: Apache-2.0
// Coding the errors of the nodes above the finest level, for both directions. Part of the player.
//
// An error is a float of which exponent and three bits after the leading one are kept: within 1/16. As integers
// these are about the logarithm; a frame's are coded as the difference to the frame before, at a key frame to the
// node before, three at a time as if they were the axes of a residual (residuals.h). How large a difference is to be
// expected is told by that of the node one frame ago and those of the nodes before it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/stream/residuals.h"

namespace limber {

inline constexpr int kDroppedErrorBits = 20;
inline constexpr std::int32_t kLargestError = 0x7f7;  // the largest that stands for a finite float

// Precondition: error is finite and >= 0. Only 0 gives 0.
inline std::int32_t quantized_error(float error) {
  if (!(error > 0.0f)) return 0;
  const auto rounded = static_cast<std::int32_t>(
      (std::bit_cast<std::uint32_t>(error) + (1u << (kDroppedErrorBits - 1))) >> kDroppedErrorBits);
  return rounded < 1 ? 1 : rounded > kLargestError ? kLargestError : rounded;
}

inline float error_value(std::int32_t quantized) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(quantized) << kDroppedErrorBits);
}

// What coding a frame leaves for the next.
struct ErrorState {
  struct Node {
    std::int32_t error = 0;       // quantised
    std::uint32_t magnitude = 0;  // of the last step's difference, counted as residuals are
  };

  explicit ErrorState(std::size_t count) : nodes(count) {}

  std::vector<Node> nodes;  // by number less that of finest vertices
  ResidualStatistics key_statistics, step_statistics;
};

// The table of a step's difference. The highest four are for nodes that gained or lost a child; one is for nodes
// without an error, which mostly stay so: that one is free, as no activity leads to it.
inline unsigned error_table(const ErrorState::Node& node, bool changed, std::uint32_t neighborhood) {
  constexpr unsigned kChangedTables = 4, kOtherTables = kContextCount - kChangedTables;
  if (changed) return kOtherTables + std::min(residual_context(neighborhood / 6).table, kChangedTables - 1);
  if (node.error == 0) return 1;
  return std::min(residual_context((neighborhood + 12 * node.magnitude) / 6).table, kOtherTables - 1);
}

// `changed`: whether a child came or went. `actual(i)` gives the quantised error to write. Both by number less that of
// finest vertices. False where the bytes are wrong.
template <class Coder, class Actual>
bool code_errors(Coder& coder, ErrorState& state, bool key, std::span<const std::uint8_t> changed, Actual&& actual) {
  std::int32_t last = 0;
  std::uint32_t neighborhood = 0;  // four times a running mean of the magnitudes of three
  for (std::size_t begin = 0; begin < state.nodes.size(); begin += 3) {
    const std::size_t count = std::min<std::size_t>(3, state.nodes.size() - begin);
    const std::span nodes = std::span(state.nodes).subspan(begin, count);
    Lattice differences{};
    if constexpr (Coder::kEncodes) {
      std::int32_t base = last;
      for (std::size_t k = 0; k < count; ++k) {
        const std::int32_t error = actual(begin + k);
        differences[k] = error - (key ? base : nodes[k].error);
        base = error;
      }
    }
    if (key) {
      const std::uint32_t expected = neighborhood / 3;
      differences = coder.code({expected, expected, expected}, differences);
    } else {
      std::array<unsigned, 3> tables{};
      for (std::size_t k = 0; k < count; ++k) tables[k] = error_table(nodes[k], changed[begin + k] != 0, neighborhood);
      differences = coder.code_in(tables, differences);
    }
    neighborhood -= neighborhood / 4;
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t error = std::int64_t{differences[k]} + (key ? last : nodes[k].error);
      if (error < 0 || error > kLargestError) return false;
      const std::uint32_t magnitude = counted_magnitude(differences[k]);
      nodes[k] = {static_cast<std::int32_t>(error), key ? 0 : magnitude};
      neighborhood += magnitude;
      last = nodes[k].error;
    }
  }
  return true;
}

}  // namespace limber
