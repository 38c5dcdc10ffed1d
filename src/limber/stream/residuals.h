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

// What the surroundings of a residual suggest: a table, and how many low bits of the magnitude are plain.
struct ResidualContext {
  int table;
  unsigned shift;
};

// `activity`: four times the expected magnitude.
inline ResidualContext residual_context(std::uint64_t activity) {
  const std::uint64_t u = activity + 1;
  const int octave = static_cast<int>(std::bit_width(u)) - 1;
  const int level = octave == 0 ? 0 : 2 * octave + static_cast<int>((u >> (octave - 1)) & 1);
  return {level < kContextCount ? level : kContextCount - 2 + (level & 1),
          level < 12 ? 0u : static_cast<unsigned>(level - 10) / 2};
}

// Four times sum / weight, rounded down or one less. Precondition: sum < 2^44, 1 <= weight <= kMostActivityWeight.
inline constexpr std::size_t kMostActivityWeight = 40;
inline constexpr auto kReciprocals = [] {
  std::array<std::uint32_t, kMostActivityWeight + 1> reciprocals{};
  for (std::uint32_t i = 1; i < reciprocals.size(); ++i) reciprocals[i] = (1u << 18) / i;
  return reciprocals;
}();
inline std::uint64_t quadruple_mean(std::uint64_t sum, std::size_t weight) {
  return (sum * kReciprocals[weight]) >> 16;
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

  // `count` <= 32.
  std::uint32_t read(unsigned count) {
    if (filled_ < count) refill();
    const auto value = static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << count) - 1));
    bits_ >>= count;
    filled_ -= count;
    return value;
  }

 private:
  void refill() {
    if (end_ - at_ >= 4) {
      bits_ |= std::uint64_t{load_little_endian<std::uint32_t>(at_)} << filled_;
      at_ += 4;
      filled_ += 32;
      return;
    }
    while (filled_ < 32) {
      if (at_ != end_) bits_ |= std::uint64_t{std::to_integer<std::uint8_t>(*at_++)} << filled_;
      filled_ += 8;
    }
  }

  const std::byte* at_;
  const std::byte* end_;
  std::uint64_t bits_ = 0;
  unsigned filled_ = 0;
};

class ResidualReader {
 public:
  static constexpr bool kEncodes = false;

  ResidualReader(std::span<const std::byte> bytes, ResidualStatistics& statistics);

  // Gives the residual on the axis; `residual` is ignored.
  std::int32_t code(std::size_t axis, std::uint64_t activity, std::int32_t = 0) {
    const auto [table_index, shift] = residual_context(activity);
    const ResidualStatistics::Table& table = statistics_.table(table_index);
    std::uint32_t& state = states_[axis];
    const std::uint32_t slot = state & ((1u << kFrequencyBits) - 1);
    const std::uint8_t c = table.class_at[slot];
    state = table.frequency[c] * (state >> kFrequencyBits) + slot - table.start[c];
    if (state < (1u << 16)) state = state << 16 | next_word();
    statistics_.count(table_index, c);
    std::uint32_t magnitude;
    if (c == kEscapeClass) [[unlikely]] {
      magnitude = bits_.read(32);
    } else {
      magnitude = kClasses[c].first;
      const unsigned plain = std::min(kClasses[c].bits + shift, 32u);  // more only in bytes that no encoder writes
      magnitude <<= shift;
      if (plain > 0) magnitude += bits_.read(plain);
    }
    if (magnitude == 0) return 0;
    const std::uint32_t negative = 0u - bits_.read(1);
    return static_cast<std::int32_t>((magnitude ^ negative) - negative);
  }

  // Whether all was as an encoder writes it. Call after the last residual.
  bool consistent() const {
    return words_ == words_end_ && states_ == std::array<std::uint32_t, 3>{1u << 16, 1u << 16, 1u << 16};
  }

 private:
  std::uint32_t next_word() {
    if (words_ == words_end_) return 0;
    const std::uint32_t word = load_little_endian<std::uint16_t>(words_);
    words_ += 2;
    return word;
  }

  ResidualStatistics& statistics_;
  std::array<std::uint32_t, 3> states_{};
  const std::byte* words_ = nullptr;
  const std::byte* words_end_ = nullptr;
  BitReader bits_;
};

// Numeral systems are last in, first out: classes are kept and coded backwards at the end.
class ResidualWriter {
 public:
  static constexpr bool kEncodes = true;

  explicit ResidualWriter(ResidualStatistics& statistics) : statistics_(statistics) {}

  std::int32_t code(std::size_t axis, std::uint64_t activity, std::int32_t residual);

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
