// SPDX-License-Identifier: Apache-2.0
// Residuals of predicted coordinates as bytes: a magnitude class by range asymmetric numeral systems (Duda 2013)
// with a table for each context, the rest as plain bits. The context of a residual is the size that its
// surroundings suggest. Tables follow what has been coded since the last key frame; none is ever stored.
// Part of the player.
//
// The bytes: three states, one per axis (uint32 each); the number of words that follow (uint32); words (uint16
// each); plain bits, lowest first, to the end.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/stream/bytes.h"
#include "limber/stream/quantizer.h"

namespace limber {

inline constexpr int kContextCount = 16;
inline constexpr int kClassCount = 27;
inline constexpr int kEscapeClass = kClassCount - 1;
inline constexpr unsigned kFrequencyBits = 12;

// A class holds the magnitudes first ... first + 2^bits - 1 (after the shift of the context).
struct MagnitudeClass {
  std::uint16_t first;
  std::uint8_t bits;
};

inline constexpr std::array<MagnitudeClass, kClassCount> kClasses{
    {{0, 0},  {1, 0},  {2, 0},  {3, 0},   {4, 0},   {5, 0},   {6, 0},     {7, 0},     {8, 0},
     {9, 0},  {10, 0}, {11, 0}, {12, 0},  {13, 0},  {14, 0},  {15, 0},    {16, 3},    {24, 3},
     {32, 4}, {48, 4}, {64, 6}, {128, 7}, {256, 8}, {512, 9}, {1024, 10}, {2048, 11}, {4096, 32}}};

// The class of a shifted magnitude.
constexpr int class_of(std::uint32_t magnitude) {
  if (magnitude < 16) return static_cast<int>(magnitude);
  const int octave = static_cast<int>(std::bit_width(magnitude)) - 1;
  if (octave >= 12) return kEscapeClass;
  if (octave < 6) return 16 + 2 * (octave - 4) + static_cast<int>((magnitude >> (octave - 1)) & 1);
  return 14 + octave;
}

// For each axis four times the magnitude to expect.
using Activity = std::array<std::uint32_t, 3>;

// What the surroundings of a residual suggest: a table, and how many low bits of the magnitude are plain.
struct ResidualContext {
  int table;
  unsigned shift;
};

// Precondition: activity < 2^31.
inline ResidualContext residual_context(std::uint32_t activity) {
  const std::uint32_t u = activity + 1;
  const int octave = static_cast<int>(std::bit_width(u)) - 1;
  const int level = octave == 0 ? 0 : 2 * octave + static_cast<int>((u >> (octave - 1)) & 1);
  return {level < kContextCount ? level : kContextCount - 2 + (level & 1),
          level < 12 ? 0u : static_cast<unsigned>(level - 10) / 2};
}

// Larger residuals count as this where the next are expected: sums stay within 21 bits.
inline constexpr std::uint32_t kMostMagnitude = 1 << 15;

inline std::uint32_t counted_magnitude(std::int32_t residual) {
  const auto bits = static_cast<std::uint32_t>(residual);
  return std::min(residual < 0 ? 0u - bits : bits, kMostMagnitude);
}

// Four times sum / weight, rounded down or one less. Precondition: sum < 2^44, 1 <= weight <= kMostActivityWeight.
inline constexpr std::size_t kMostActivityWeight = 40;
inline constexpr auto kReciprocals = [] {
  std::array<std::uint32_t, kMostActivityWeight + 1> reciprocals{};
  for (std::uint32_t i = 1; i < reciprocals.size(); ++i) reciprocals[i] = (1u << 18) / i;
  return reciprocals;
}();
inline std::uint32_t quadruple_mean(std::uint64_t sum, std::size_t weight) {
  return static_cast<std::uint32_t>((sum * kReciprocals[weight]) >> 16);
}

// The frequencies of the classes in each context, and how often each was met lately.
class ResidualStatistics {
 public:
  ResidualStatistics() { reset(); }

  // What is assumed at a key frame.
  void reset();

  void count(int table, int magnitude_class) {
    ++counts_[static_cast<std::size_t>(table)][static_cast<std::size_t>(magnitude_class)];
  }

  // Frequencies from counts: after a frame.
  void update();

  struct Table {
    std::array<std::uint16_t, kClassCount> frequency;
    std::array<std::uint16_t, kClassCount> start;
    std::array<std::uint8_t, 1 << kFrequencyBits> class_at;
  };
  const Table& table(int i) const { return tables_[static_cast<std::size_t>(i)]; }

 private:
  std::array<std::array<std::uint32_t, kClassCount>, kContextCount> counts_;
  std::array<Table, kContextCount> tables_;
};

// Plain bits, lowest first; past the end there are zeros.
class BitReader {
 public:
  explicit BitReader(std::span<const std::byte> bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

  // Makes at least 56 bits ready.
  void fill() {
    if (end_ - at_ >= 8) {
      bits_ |= load_little_endian<std::uint64_t>(at_) << filled_;
      at_ += (63 - filled_) >> 3;
      filled_ |= 56;
      return;
    }
    for (; filled_ < 56; filled_ += 8)
      if (at_ != end_) bits_ |= std::uint64_t{std::to_integer<std::uint8_t>(*at_++)} << filled_;
  }

  // Precondition: the bits are ready.
  std::uint32_t peek() const { return static_cast<std::uint32_t>(bits_); }
  void skip(unsigned count) {
    bits_ >>= count;
    filled_ -= count;
  }

  // `count` <= 32. Precondition: the bits are ready.
  std::uint32_t read(unsigned count) {
    const auto value = static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << count) - 1));
    skip(count);
    return value;
  }

 private:
  const std::byte* at_;
  const std::byte* end_;
  std::uint64_t bits_ = 0;
  unsigned filled_ = 0;
};

class ResidualReader {
 public:
  static constexpr bool kEncodes = false;

  ResidualReader(std::span<const std::byte> bytes, ResidualStatistics& statistics);

  // Gives the residuals on the three axes; `activity`: what to expect on each (residual_context()).
  Lattice code(const Activity& activity, const Lattice& = {}) {
    // In local variables: else the counts that are written might be taken for them.
    Cursor cursor = cursor_;
    const std::int32_t x = code_axis(activity[0], cursor.states[0], cursor);
    const std::int32_t y = code_axis(activity[1], cursor.states[1], cursor);
    const std::int32_t z = code_axis(activity[2], cursor.states[2], cursor);
    cursor_ = cursor;
    return {x, y, z};
  }

  // Whether all was as an encoder writes it. Call after the last residual.
  bool consistent() const {
    return cursor_.word_at == word_count_ &&
           cursor_.states == std::array<std::uint32_t, 3>{1u << 16, 1u << 16, 1u << 16};
  }

 private:
  struct Cursor {
    std::array<std::uint32_t, 3> states{};
    std::size_t word_at = 0;
    BitReader bits{{}};
  };

  // No branch but the one for the escape depends on the residual: it could not be foretold.
  [[gnu::always_inline]] std::int32_t code_axis(std::uint32_t activity, std::uint32_t& state, Cursor& cursor) {
    const auto [table_index, shift] = residual_context(activity);
    const ResidualStatistics::Table& table = statistics_.table(table_index);
    const std::uint32_t slot = state & ((1u << kFrequencyBits) - 1);
    const std::uint8_t c = table.class_at[slot];
    const std::uint32_t wide = table.frequency[c] * (state >> kFrequencyBits) + slot - table.start[c];
    const bool needs_word = wide < (1u << 16);
    const std::uint32_t word =
        cursor.word_at < word_count_ ? load_little_endian<std::uint16_t>(words_ + 2 * cursor.word_at) : 0u;
    state = needs_word ? wide << 16 | word : wide;
    cursor.word_at += needs_word;
    statistics_.count(table_index, c);
    cursor.bits.fill();
    std::uint32_t magnitude;
    if (c == kEscapeClass) [[unlikely]] {
      magnitude = cursor.bits.read(32);
    } else {
      const MagnitudeClass magnitude_class = kClasses[c];
      const unsigned plain = std::min(magnitude_class.bits + shift, 32u);  // more only in bytes of no encoder
      magnitude = (std::uint32_t{magnitude_class.first} << shift) + cursor.bits.read(plain);
    }
    const std::uint32_t has_sign = magnitude != 0;
    const std::uint32_t negative = 0u - (cursor.bits.peek() & has_sign);
    cursor.bits.skip(has_sign);
    return static_cast<std::int32_t>((magnitude ^ negative) - negative);
  }

  ResidualStatistics& statistics_;
  Cursor cursor_;
  const std::byte* words_ = nullptr;
  std::size_t word_count_ = 0;
};

// Numeral systems are last in, first out: classes are kept and coded backwards at the end.
class ResidualWriter {
 public:
  static constexpr bool kEncodes = true;

  explicit ResidualWriter(ResidualStatistics& statistics) : statistics_(statistics) {}

  Lattice code(const Activity& activity, const Lattice& residuals);

  // The bytes written.
  std::vector<std::byte> finish() const;

 private:
  void write_bits(std::uint32_t value, unsigned count);

  struct Symbol {
    std::uint8_t axis, table, magnitude_class;
  };

  ResidualStatistics& statistics_;
  std::vector<Symbol> symbols_;
  std::vector<std::byte> bits_;
  std::uint64_t pending_ = 0;
  unsigned pending_count_ = 0;
};

}  // namespace limber
