// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/residuals.h"

#include <numeric>

namespace limber {
namespace {

// Counts are halved when a context has met this many.
constexpr std::uint32_t kMostCounted = 1 << 14;

// The weight of the assumption at a key frame, in symbols.
constexpr std::uint32_t kAssumed = 96;

constexpr std::size_t kStatesSize = 3 * 4 + 4;

using Counts = std::array<std::array<std::uint32_t, kClassCount>, kContextCount>;

// For each context a geometric distribution whose mean is the size that the context stands for.
constexpr Counts kAssumedCounts = [] {
  Counts counts{};
  for (std::size_t t = 0; t < kContextCount; ++t) {
    const std::size_t octave = t / 2 < 5 ? t / 2 : 5;  // from there on the shift keeps pace
    const std::uint64_t mean_times_8 = t == 0 ? 1 : ((2 + (t & 1)) << octave) - 1;
    std::uint64_t left = std::uint64_t{1} << 32;  // probability of this magnitude and all above
    std::uint32_t magnitude = 0;
    for (std::size_t c = 0; c < kEscapeClass; ++c) {
      std::uint64_t probability = 0;
      for (const std::uint32_t end = kClasses[c].first + (1u << kClasses[c].bits); magnitude < end; ++magnitude) {
        const std::uint64_t here = left * 8 / (mean_times_8 + 8);
        probability += here;
        left -= here;
      }
      counts[t][c] = static_cast<std::uint32_t>((probability * kAssumed) >> 32);
    }
    counts[t][kEscapeClass] = static_cast<std::uint32_t>((left * kAssumed) >> 32);
  }
  return counts;
}();

}  // namespace

void ResidualStatistics::reset() {
  counts_ = kAssumedCounts;
  update();
}

void ResidualStatistics::update() {
  for (std::size_t t = 0; t < kContextCount; ++t) {
    auto& counts = counts_[t];
    Table& table = tables_[t];
    std::uint32_t total = std::accumulate(counts.begin(), counts.end(), 0u);
    while (total > kMostCounted) {
      for (std::uint32_t& count : counts) count >>= 1;
      total = std::accumulate(counts.begin(), counts.end(), 0u);
    }
    // Every class keeps a frequency of at least 1: it may come although it never did.
    constexpr std::uint32_t kShared = (1u << kFrequencyBits) - kClassCount;
    std::uint32_t rest = kShared;
    for (std::size_t c = 0; c < kClassCount; ++c) {
      const std::uint32_t share = total == 0 ? 0 : counts[c] * kShared / total;
      table.frequency[c] = static_cast<std::uint16_t>(1 + share);
      rest -= share;
    }
    const auto most = static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
    table.frequency[most] = static_cast<std::uint16_t>(table.frequency[most] + rest);
    std::uint32_t start = 0;
    for (std::size_t c = 0; c < kClassCount; ++c) {
      table.start[c] = static_cast<std::uint16_t>(start);
      std::fill_n(table.class_at.begin() + start, table.frequency[c], static_cast<std::uint8_t>(c));
      start += table.frequency[c];
    }
  }
}

ResidualReader::ResidualReader(std::span<const std::byte> bytes, ResidualStatistics& statistics)
    : statistics_(statistics) {
  if (bytes.size() < kStatesSize) return;
  const std::size_t word_count = load_little_endian<std::uint32_t>(&bytes[12]);
  if (word_count > (bytes.size() - kStatesSize) / 2) return;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cursor_.states[axis] = load_little_endian<std::uint32_t>(&bytes[4 * axis]);
  words_ = bytes.data() + kStatesSize;
  word_count_ = word_count;
  cursor_.bits = BitReader(bytes.subspan(kStatesSize + 2 * word_count));
}

Lattice ResidualWriter::code(const Activity& activity, const Lattice& residuals) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [table, shift] = residual_context(activity[axis]);
    const auto bits = static_cast<std::uint32_t>(residuals[axis]);
    const std::uint32_t magnitude = residuals[axis] < 0 ? 0u - bits : bits;
    const int c = class_of(magnitude >> shift);
    statistics_.count(table, c);
    symbols_.push_back(
        {static_cast<std::uint8_t>(axis), static_cast<std::uint8_t>(table), static_cast<std::uint8_t>(c)});
    if (c == kEscapeClass) {
      write_bits(magnitude, 32);
    } else {
      const MagnitudeClass& magnitude_class = kClasses[static_cast<std::size_t>(c)];
      write_bits(magnitude - (std::uint32_t{magnitude_class.first} << shift), magnitude_class.bits + shift);
    }
    if (magnitude != 0) write_bits(residuals[axis] < 0, 1);
  }
  return residuals;
}

std::vector<std::byte> ResidualWriter::finish() const {
  std::array<std::uint32_t, 3> states{1u << 16, 1u << 16, 1u << 16};
  std::vector<std::uint16_t> words;
  for (std::size_t i = symbols_.size(); i-- > 0;) {
    const auto [axis, table_index, c] = symbols_[i];
    const ResidualStatistics::Table& table = statistics_.table(table_index);
    const std::uint32_t frequency = table.frequency[c];
    std::uint32_t& state = states[axis];
    if (state >= std::uint64_t{frequency} << (32 - kFrequencyBits)) {
      words.push_back(static_cast<std::uint16_t>(state));
      state >>= 16;
    }
    state = (state / frequency << kFrequencyBits) + state % frequency + table.start[c];
  }
  std::vector<std::byte> bytes;
  for (const std::uint32_t state : states) append_little_endian(bytes, state);
  append_little_endian(bytes, static_cast<std::uint32_t>(words.size()));
  for (std::size_t i = words.size(); i-- > 0;) append_little_endian(bytes, words[i]);
  bytes.insert(bytes.end(), bits_.begin(), bits_.end());
  for (unsigned done = 0; done < pending_count_; done += 8) bytes.push_back(static_cast<std::byte>(pending_ >> done));
  return bytes;
}

void ResidualWriter::write_bits(std::uint32_t value, unsigned count) {
  pending_ |= std::uint64_t{value} << pending_count_;
  pending_count_ += count;
  for (; pending_count_ >= 8; pending_count_ -= 8, pending_ >>= 8) bits_.push_back(static_cast<std::byte>(pending_));
}

}  // namespace limber
