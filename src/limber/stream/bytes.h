// SPDX-License-Identifier: Apache-2.0
// Little-endian numbers in bytes, on any machine. Part of the player.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace limber {

// Precondition: sizeof(T) bytes are there.
template <class T>
T load_little_endian(const std::byte* from) {
  T value = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&value, from, sizeof(T));  // compilers do not always see that the loop is one load
    return value;
  }
  for (std::size_t i = 0; i < sizeof(T); ++i)
    value = static_cast<T>(value | static_cast<T>(static_cast<T>(std::to_integer<unsigned>(from[i])) << (8 * i)));
  return value;
}

template <class T>
void append_little_endian(std::vector<std::byte>& to, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) to.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xff));
}

inline void append_double(std::vector<std::byte>& to, double value) {
  append_little_endian(to, std::bit_cast<std::uint64_t>(value));
}

// Reads fields one after another; past the end it gives zeros and remembers that it did.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::uint32_t u32() { return read<std::uint32_t>(); }
  std::uint64_t u64() { return read<std::uint64_t>(); }
  double f64() { return std::bit_cast<double>(u64()); }

  std::size_t left() const { return bytes_.size(); }
  bool overrun() const { return overrun_; }

 private:
  template <class T>
  T read() {
    if (bytes_.size() < sizeof(T)) {
      overrun_ = true;
      return 0;
    }
    const T value = load_little_endian<T>(bytes_.data());
    bytes_ = bytes_.subspan(sizeof(T));
    return value;
  }

  std::span<const std::byte> bytes_;
  bool overrun_ = false;
};

}  // namespace limber
