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
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/stream/bytes.h"
#include "limber/stream/quantizer.h"

namespace limber {

inline constexpr unsigned kContextCount = 16;
inline constexpr unsigned kClassCount = 27;
inline constexpr unsigned kEscapeClass = kClassCount - 1;
inline constexpr unsigned kFrequencyBits = 11;

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
constexpr unsigned class_of(std::uint32_t magnitude) {
  if (magnitude < 16) return magnitude;
  const auto octave = static_cast<unsigned>(std::bit_width(magnitude)) - 1;
  if (octave >= 12) return kEscapeClass;
  if (octave < 6) return 16 + 2 * (octave - 4) + ((magnitude >> (octave - 1)) & 1);
  return 14 + octave;
}

// For each axis four times the magnitude to expect.
using Activity = std::array<std::uint32_t, 3>;

// What the surroundings of a residual suggest: a table, and how many low bits of the magnitude are plain.
struct ResidualContext {
  unsigned table;
  unsigned shift;
};

// No activity is as large: no class has more than 32 plain bits.
inline constexpr std::uint32_t kActivityEnd = 1 << 26;

// Below this nothing is shifted.
inline constexpr std::uint32_t kShiftedActivity = 63;

// Precondition: activity < kActivityEnd.
constexpr ResidualContext residual_context(std::uint32_t activity) {
  assert(activity < kActivityEnd);
  const std::uint32_t u = 2 * (activity + 1);
  const unsigned octave = static_cast<unsigned>(std::bit_width(u)) - 1;
  const unsigned level = 2 * octave - 4 + (u >> (octave - 1));  // the upper two bits are 2 or 3
  return {std::min(level, kContextCount - 2 + (level & 1)), (std::max(level, 11u) - 10) / 2};
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
  // What a class has of the 2^kFrequencyBits slots of its table: `frequency` from `start` on.
  struct Share {
    std::uint16_t frequency;
    std::uint16_t start;
    std::uint32_t count;  // how often it was met lately
  };

  ResidualStatistics() { reset(); }

  // What is assumed at a key frame.
  void reset();

  // Frequencies from counts: after a frame.
  void update();

  // Preconditions: table < kContextCount, magnitude_class < kClassCount, slot < 2^kFrequencyBits.
  Share& share(unsigned table, std::size_t magnitude_class) { return shares_[table][magnitude_class]; }
  const Share& share(unsigned table, std::size_t magnitude_class) const { return shares_[table][magnitude_class]; }
  std::uint8_t class_at(unsigned table, std::uint32_t slot) const { return class_at_[table][slot]; }

 private:
  static constexpr std::size_t kRowSize = std::bit_ceil(std::size_t{kClassCount});

  std::array<std::array<Share, kRowSize>, kContextCount> shares_{};
  std::array<std::uint32_t, kContextCount> totals_{};  // sums of the counts that the shares were made of
  std::array<std::array<std::uint8_t, 1 << kFrequencyBits>, kContextCount> class_at_;
};

class ResidualReader {
 public:
  static constexpr bool kEncodes = false;

  ResidualReader(std::span<const std::byte> bytes, ResidualStatistics& statistics);

  // Gives the residuals on the three axes; `activity`: what to expect on each (residual_context()). Axes go side by
  // side, so that a processor overlaps them. No branch but the rare one for an escape depends on what is read.
  [[gnu::always_inline]] Lattice code(const Activity& activity, const Lattice& = {}) {
    if ((activity[0] | activity[1] | activity[2]) >= kShiftedActivity) return code_shifted(activity);
    return code_in({kSmallTables[activity[0]], kSmallTables[activity[1]], kSmallTables[activity[2]]});
  }

  // The same by the tables, each < kContextCount, with nothing shifted.
  [[gnu::always_inline]] Lattice code_in(const std::array<unsigned, 3>& tables, const Lattice& = {}) {
    const std::array<std::size_t, 3> classes = read_classes(tables);
    // Where a class ends among the bits follows from the classes alone.
    const PlainPart &x = kPlainParts[classes[0]], &y = kPlainParts[classes[1]], &z = kPlainParts[classes[2]];
    const std::uint32_t length = x.length + y.length + z.length;
    if (length >= kEscapeLength) [[unlikely]]
      return read_one_by_one(classes, {});
    const std::uint64_t bits = eight_bytes(plain_, bit_at_ >> 3) >> (bit_at_ & 7);
    bit_at_ += length;
    return {residual(x, bits), residual(y, bits >> x.length), residual(z, bits >> (x.length + y.length))};
  }

  // Whether all was as an encoder writes it. Call after the last residual.
  bool consistent() const {
    return word_at_ == word_count_ && states_ == std::array<std::uint32_t, 3>{1u << 16, 1u << 16, 1u << 16};
  }

 private:
  // Of eight bytes that begin at any bit so many are whole.
  static constexpr unsigned kWholeBits = 57;
  static constexpr std::uint16_t kEscapeLength = 64;

  // What follows a class that is not shifted: plain bits and, unless the magnitude is 0, a sign.
  struct PlainPart {
    std::uint16_t first, mask, bits, length;
  };
  static constexpr auto kPlainParts = [] {
    std::array<PlainPart, kClassCount> parts{};
    for (std::size_t c = 0; c < kEscapeClass; ++c)
      parts[c] = {kClasses[c].first, static_cast<std::uint16_t>((1u << kClasses[c].bits) - 1), kClasses[c].bits,
                  static_cast<std::uint16_t>(kClasses[c].bits + (c != 0))};
    parts[kEscapeClass].length = kEscapeLength;
    return parts;
  }();
  static_assert(3 * (kClasses[kEscapeClass - 1].bits + 1) <= kWholeBits);

  static constexpr auto kSmallTables = [] {
    std::array<std::uint8_t, kShiftedActivity> tables{};
    for (std::uint32_t activity = 0; activity < kShiftedActivity; ++activity)
      tables[activity] = static_cast<std::uint8_t>(residual_context(activity).table);
    return tables;
  }();

  // Precondition: `bits` begin with the part. The sign of a 0, a bit of whatever follows, changes nothing.
  static std::int32_t residual(const PlainPart& part, std::uint64_t bits) {
    const std::uint32_t magnitude = part.first + (static_cast<std::uint32_t>(bits) & part.mask);
    const std::uint32_t negative = 0u - (static_cast<std::uint32_t>(bits >> part.bits) & 1);
    return static_cast<std::int32_t>((magnitude ^ negative) - negative);
  }

  // The classes in the three tables. States and counts go on.
  [[gnu::always_inline]] std::array<std::size_t, 3> read_classes(const std::array<unsigned, 3>& tables) {
    std::array<std::size_t, 3> classes;
    std::array<std::uint32_t, 3> wide;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t slot = states_[k] & ((1u << kFrequencyBits) - 1);
      classes[k] = statistics_.class_at(tables[k], slot);
      ResidualStatistics::Share& share = statistics_.share(tables[k], classes[k]);
      wide[k] = share.frequency * (states_[k] >> kFrequencyBits) + slot - share.start;
      ++share.count;
    }
    std::uint64_t words = eight_bytes(words_, 2 * word_at_);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t needs_word = wide[k] < (1u << 16);
      states_[k] = wide[k] << (16 * needs_word) | (static_cast<std::uint16_t>(words) & (0u - needs_word));
      words >>= 16 * needs_word;
      word_at_ += needs_word;
    }
    return classes;
  }

  Lattice code_shifted(const Activity& activity);
  Lattice read_one_by_one(const std::array<std::size_t, 3>& classes, const std::array<unsigned, 3>& shifts);

  // Those from `at` on; past the end there are zeros.
  static std::uint64_t eight_bytes(std::span<const std::byte> bytes, std::uint64_t at) {
    if (at + 8 <= bytes.size()) [[likely]]
      return load_little_endian<std::uint64_t>(bytes.data() + at);
    return last_bytes(bytes, at);
  }
  static std::uint64_t last_bytes(std::span<const std::byte> bytes, std::uint64_t at);

  ResidualStatistics& statistics_;
  std::array<std::uint32_t, 3> states_{};
  std::span<const std::byte> words_;  // and the plain bits after them: where words are missing consistent() says so
  std::span<const std::byte> plain_;
  std::uint64_t word_at_ = 0, word_count_ = 0;
  std::uint64_t bit_at_ = 0;
};

// Numeral systems are last in, first out: classes are kept and coded backwards at the end.
class ResidualWriter {
 public:
  static constexpr bool kEncodes = true;

  explicit ResidualWriter(ResidualStatistics& statistics) : statistics_(statistics) {}

  Lattice code(const Activity& activity, const Lattice& residuals);
  Lattice code_in(const std::array<unsigned, 3>& tables, const Lattice& residuals);

  // The bytes written.
  std::vector<std::byte> finish() const;

 private:
  void write(std::size_t axis, const ResidualContext& context, std::int32_t residual);
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
