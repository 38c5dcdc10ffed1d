// SPDX-License-Identifier: Apache-2.0
// Numbers as bytes of a stated order, whatever the order of the machine.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace limber {

// The unsigned number in the sizeof(T) bytes at `bytes`. Compilers make one load of it.
template <std::unsigned_integral T, std::endian kOrder>
T load(const char* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t place = kOrder == std::endian::little ? i : sizeof(T) - 1 - i;
    value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * place);
  }
  return static_cast<T>(value);
}

template <std::unsigned_integral T, std::endian kOrder>
void store(T value, char* bytes) {
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const std::size_t place = kOrder == std::endian::little ? i : sizeof(T) - 1 - i;
    bytes[i] = static_cast<char>(static_cast<unsigned char>(std::uint64_t{value} >> (8 * place)));
  }
}

template <std::endian kOrder>
float load_float(const char* bytes) {
  return std::bit_cast<float>(load<std::uint32_t, kOrder>(bytes));
}

template <std::endian kOrder>
void store_float(float value, char* bytes) {
  store<std::uint32_t, kOrder>(std::bit_cast<std::uint32_t>(value), bytes);
}

}  // namespace limber
