// SPDX-License-Identifier: Apache-2.0
// Coding the errors of the nodes above the finest level, for both directions. Part of the player.
//
// An error is a float of which exponent and three bits after the leading one are kept: within 1/16. As integers
// these are about the logarithm; a frame's are coded as the difference to the frame before, at a key frame to the
// node before.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/stream/range_coder.h"

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

struct ErrorModels {
  DifferenceModel key;
  std::array<DifferenceModel, 9> step;  // by whether the node's cluster changed, and the size of the difference before
};

// `errors`: quantised, those of the frame before; becomes those of this frame. `changed`: whether a child came or
// went. `actual(i)` gives the quantised error to write. All by node less the number of finest vertices.
// False where the bytes are wrong.
template <class Coder, class Actual>
bool code_errors(Coder& coder, ErrorModels& models, bool key, std::span<const std::uint8_t> changed,
                 std::span<std::int32_t> errors, Actual&& actual) {
  std::int32_t last = 0;
  std::size_t size_before = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::int32_t base = key ? last : errors[i];
    DifferenceModel& model = key ? models.key : models.step[(base == 0 ? 2u : changed[i]) * 3u + size_before];
    std::int32_t difference = 0;
    if constexpr (Coder::kEncodes) difference = actual(i) - base;
    difference = model.code(coder, difference);
    if (difference < -base || difference > kLargestError - base) return false;
    last = errors[i] = base + difference;
    size_before = difference == 0 ? 0 : difference >= -1 && difference <= 1 ? 1 : 2;
  }
  return true;
}

}  // namespace limber
