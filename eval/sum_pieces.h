// SPDX-License-Identifier: Apache-2.0
// Sums over many items, in parallel, with the same rounding for every number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "eval/parallel_for.h"

namespace limber::eval {

// Items that one task takes. Part of the results: sums are made per piece, then over the pieces.
inline constexpr std::size_t kPiece = 1024;

// Calls piece(first, count), which gives a Sums, for the pieces of 0 .. total, in parallel, and adds up what they
// give, in order. Sums has += and starts at zero.
template <class Sums, class Piece>
Sums sum_pieces(std::size_t total, const Piece& piece) {
  std::vector<Sums> sums((total + kPiece - 1) / kPiece);
  parallel_for(sums.size(), [&](std::size_t i) { sums[i] = piece(i * kPiece, std::min(kPiece, total - i * kPiece)); });
  Sums all;
  for (const Sums& part : sums) all += part;
  return all;
}

}  // namespace limber::eval
