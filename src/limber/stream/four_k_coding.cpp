// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/four_k_coding.h"

#include <algorithm>
#include <limits>

namespace limber {
namespace {

// Rounded down.
std::int64_t mean(std::int64_t sum, std::int64_t count) {
  return sum >= 0 ? sum / count : -((count - 1 - sum) / count);
}

// The mean of value(parent), and how many bits the differences between them take. Gives 0 and 32 without parents.
template <class Value>
std::pair<std::int64_t, unsigned> average(std::span<const Index> parents, const Value& value) {
  if (parents.empty()) return {0, 32};
  std::int64_t sum = 0, low = std::numeric_limits<std::int64_t>::max(), high = std::numeric_limits<std::int64_t>::min();
  for (const Index p : parents) {
    const std::int64_t x = value(p);
    sum += x, low = std::min(low, x), high = std::max(high, x);
  }
  const auto bits = static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(high - low)));
  return {mean(sum, static_cast<std::int64_t>(parents.size())), std::min(bits, 32u)};
}

}  // namespace

LatticeGuess guess_between(std::span<const Index> parents, std::span<const Lattice> at) {
  LatticeGuess guess;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [expected, spread] = average(parents, [&](Index p) { return std::int64_t{at[p][i]}; });
    guess.expected[i] = static_cast<std::int32_t>(expected);
    guess.spread[i] = spread;
  }
  return guess;
}

// A vertex of the coarsest mesh moves as the one before it.
LatticeGuess guess_moved(Index v, std::span<const Index> parents, std::span<const Lattice> at,
                         std::span<const Lattice> now) {
  const Index before = v == 0 ? 0 : v - 1;
  const bool is_first = v == 0;
  if (parents.empty() && !is_first) parents = {&before, 1};
  LatticeGuess guess;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [moved, spread] =
        average(parents, [&](Index p) { return std::int64_t{now[p][i]} - std::int64_t{at[p][i]}; });
    guess.expected[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(at[v][i]) +
                                                  static_cast<std::uint32_t>(static_cast<std::uint64_t>(moved)));
    guess.spread[i] = spread;
  }
  return guess;
}

}  // namespace limber
