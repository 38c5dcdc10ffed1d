// SPDX-License-Identifier: Apache-2.0
// Two numbers that are computed with at once, which takes a processor the time of one; each as it would be alone.
#pragma once

#include <cmath>

namespace limber {

using Pair = double __attribute__((vector_size(16)));

inline Pair root(Pair squares) { return Pair{std::sqrt(squares[0]), std::sqrt(squares[1])}; }

}  // namespace limber
