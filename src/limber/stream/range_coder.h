// SPDX-License-Identifier: Apache-2.0
// An adaptive binary range coder (Martin 1979; carries as in LZMA) for what is rare: connectivity, parents, swaps,
// errors. Encoder and decoder have the same members: each takes the value to write, which the decoder ignores,
// and returns the value written or read. So one function template describes a section for both directions.
// Part of the player.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace limber {

// How likely a zero is: the mean of a quick and a slow estimate, in 1/65,536. Both stay at least 15 from the ends.
class BitModel {
 public:
  std::uint32_t zero() const { return (quick_ + slow_) >> 1; }

  void update(unsigned bit) {
    if (bit) {
      quick_ -= quick_ >> 4;
      slow_ -= slow_ >> 7;
    } else {
      quick_ += (65536 - quick_) >> 4;
      slow_ += (65536 - slow_) >> 7;
    }
  }

 private:
  std::uint32_t quick_ = 32768;
  std::uint32_t slow_ = 32768;
};

class RangeEncoder {
 public:
  static constexpr bool kEncodes = true;

  unsigned bit(BitModel& model, unsigned bit) {
    const std::uint32_t bound = (range_ >> 16) * model.zero();
    model.update(bit);
    if (bit) {
      low_ += bound;
      range_ -= bound;
    } else {
      range_ = bound;
    }
    normalize();
    return bit;
  }

  // `count` <= 16 bits, all equally likely.
  std::uint32_t plain(unsigned count, std::uint32_t value) {
    range_ >>= count;
    low_ += std::uint64_t{range_} * value;
    normalize();
    return value;
  }

  // The bytes written; the encoder starts anew. Zeros at the end are left out: the decoder supplies them.
  std::vector<std::byte> finish() {
    for (int i = 0; i < 5; ++i) shift_low();
    while (!bytes_.empty() && bytes_.back() == std::byte{0}) bytes_.pop_back();
    std::vector<std::byte> bytes = std::move(bytes_);
    *this = RangeEncoder();
    return bytes;
  }

 private:
  void normalize() {
    while (range_ < (1u << 24)) {
      range_ <<= 8;
      shift_low();
    }
  }

  void shift_low() {
    if (low_ < 0xff000000u || low_ > 0xffffffffu) {
      const auto carry = static_cast<std::uint8_t>(low_ >> 32);
      if (started_) bytes_.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(held_ + carry)));
      started_ = true;
      for (; held_count_ > 0; --held_count_)
        bytes_.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(0xff + carry)));
      held_ = static_cast<std::uint8_t>(low_ >> 24);
    } else {
      ++held_count_;
    }
    low_ = (low_ & 0x00ffffffu) << 8;
  }

  std::vector<std::byte> bytes_;
  std::uint64_t low_ = 0;
  std::uint32_t range_ = ~0u;
  std::uint8_t held_ = 0;       // the last byte before those that a carry may still change
  std::size_t held_count_ = 0;  // bytes 0xff after it
  bool started_ = false;        // the first byte held is always 0 and not written
};

class RangeDecoder {
 public:
  static constexpr bool kEncodes = false;

  explicit RangeDecoder(std::span<const std::byte> bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {
    for (int i = 0; i < 4; ++i) code_ = code_ << 8 | next();
  }

  unsigned bit(BitModel& model, unsigned = 0) {
    const std::uint32_t bound = (range_ >> 16) * model.zero();
    unsigned bit = 0;
    if (code_ < bound) {
      range_ = bound;
    } else {
      code_ -= bound;
      range_ -= bound;
      bit = 1;
    }
    model.update(bit);
    normalize();
    return bit;
  }

  std::uint32_t plain(unsigned count, std::uint32_t = 0) {
    range_ >>= count;
    std::uint32_t value = code_ / range_;
    const std::uint32_t largest = (1u << count) - 1;
    if (value > largest) value = largest;  // only in bytes that no encoder writes
    code_ -= value * range_;
    normalize();
    return value;
  }

 private:
  void normalize() {
    while (range_ < (1u << 24)) {
      range_ <<= 8;
      code_ = code_ << 8 | next();
    }
  }

  std::uint32_t next() { return at_ == end_ ? 0u : std::to_integer<std::uint32_t>(*at_++); }

  const std::byte* at_;
  const std::byte* end_;
  std::uint32_t code_ = 0;
  std::uint32_t range_ = ~0u;
};

// `count` <= 32 bits, all equally likely, the higher half first.
template <class Coder>
std::uint32_t code_plain(Coder& coder, unsigned count, std::uint32_t value = 0) {
  std::uint32_t result = 0;
  if (count > 16) {
    result = coder.plain(count - 16, value >> 16) << 16;
    count = 16;
  }
  if (count > 0) result |= coder.plain(count, value & ((1u << count) - 1));
  return result;
}

// One of 2^kBits symbols, each with a probability of its own.
template <unsigned kBits>
struct SymbolModel {
  std::array<BitModel, std::size_t{1} << kBits> nodes;

  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t symbol = 0) {
    std::uint32_t node = 1;
    for (unsigned i = kBits; i-- > 0;) node = node << 1 | coder.bit(nodes[node], (symbol >> i) & 1);
    return node - (1u << kBits);
  }
};

// A number below 2^32 - 1 of unknown size: Elias' gamma code of number + 1 with adaptive bits. The length in
// unary, the two bits after the leading one modelled, the others plain.
struct NumberModel {
  std::array<BitModel, 32> longer;
  std::array<std::array<BitModel, 4>, 32> leading;

  template <class Coder>
  std::uint32_t code(Coder& coder, std::uint32_t number = 0) {
    const std::uint32_t value = number + 1;
    const unsigned value_length = static_cast<unsigned>(std::bit_width(value)) - 1;
    unsigned length = 0;
    while (length < 31 && coder.bit(longer[length], value_length > length)) ++length;
    std::uint32_t result = 1;
    const unsigned modelled = length < 2 ? length : 2;
    for (unsigned i = 1; i <= modelled; ++i)
      result = result << 1 | coder.bit(leading[length][result], (value >> (length - i)) & 1);
    const unsigned rest = length - modelled;
    if (rest > 0) result = result << rest | code_plain(coder, rest, value & ((1u << rest) - 1));
    return result - 1;
  }
};

// A difference: 0, or its sign and its size.
struct DifferenceModel {
  BitModel zero;
  BitModel negative;
  NumberModel size;

  template <class Coder>
  std::int32_t code(Coder& coder, std::int32_t difference = 0) {
    if (!coder.bit(zero, difference != 0)) return 0;
    const bool below = coder.bit(negative, difference < 0) != 0;
    const std::uint32_t bits = static_cast<std::uint32_t>(difference);
    const std::uint32_t magnitude = size.code(coder, (below ? 0u - bits : bits) - 1) + 1;
    return static_cast<std::int32_t>(below ? 0u - magnitude : magnitude);
  }
};

}  // namespace limber
