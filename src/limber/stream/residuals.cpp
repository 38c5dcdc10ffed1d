// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/residuals.h"

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
  for (std::size_t t = 0; t < kContextCount; ++t)
    for (std::size_t c = 0; c < kClassCount; ++c) shares_[t][c].count = kAssumedCounts[t][c];
  totals_.fill(0);
  update();
}

void ResidualStatistics::update() {
  for (std::size_t t = 0; t < kContextCount; ++t) {
    const std::span shares = std::span(shares_[t]).first(kClassCount);
    const auto sum_counts = [&] {
      std::uint32_t sum = 0;
      for (const Share& share : shares) sum += share.count;
      return sum;
    };
    std::uint32_t total = sum_counts();
    if (total == totals_[t]) continue;
    while (total > kMostCounted) {
      for (Share& share : shares) share.count >>= 1;
      total = sum_counts();
    }
    totals_[t] = total;
    // Every class keeps a frequency of at least 1: it may come although it never did.
    constexpr std::uint32_t kShared = (1u << kFrequencyBits) - kClassCount;
    std::uint32_t rest = kShared;
    Share* most = &shares[0];
    for (Share& share : shares) {
      const std::uint32_t extra = total == 0 ? 0 : share.count * kShared / total;
      share.frequency = static_cast<std::uint16_t>(1 + extra);
      rest -= extra;
      if (share.count > most->count) most = &share;
    }
    most->frequency = static_cast<std::uint16_t>(most->frequency + rest);
    std::uint32_t start = 0;
    for (std::size_t c = 0; c < kClassCount; ++c) {
      shares[c].start = static_cast<std::uint16_t>(start);
      std::fill_n(class_at_[t].begin() + start, shares[c].frequency, static_cast<std::uint8_t>(c));
      start += shares[c].frequency;
    }
  }
}

ResidualReader::ResidualReader(std::span<const std::byte> bytes, ResidualStatistics& statistics)
    : statistics_(statistics) {
  if (bytes.size() < kStatesSize) return;
  const std::size_t word_count = load_little_endian<std::uint32_t>(&bytes[12]);
  if (word_count > (bytes.size() - kStatesSize) / 2) return;
  for (std::size_t axis = 0; axis < 3; ++axis) states_[axis] = load_little_endian<std::uint32_t>(&bytes[4 * axis]);
  words_ = bytes.subspan(kStatesSize);
  plain_ = words_.subspan(2 * word_count);
  word_count_ = word_count;
}

std::uint64_t ResidualReader::last_bytes(std::span<const std::byte> bytes, std::uint64_t at) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; at < bytes.size() && shift < 64; shift += 8)
    value |= std::uint64_t{std::to_integer<std::uint8_t>(bytes[static_cast<std::size_t>(at++)])} << shift;
  return value;
}

Lattice ResidualReader::code_shifted(const Activity& activity) {
  std::array<unsigned, 3> tables, shifts;
  for (std::size_t k = 0; k < 3; ++k) {
    const ResidualContext context = residual_context(activity[k]);
    tables[k] = context.table;
    shifts[k] = context.shift;
  }
  return read_one_by_one(read_classes(tables), shifts);
}

Lattice ResidualReader::read_one_by_one(const std::array<std::size_t, 3>& classes,
                                        const std::array<unsigned, 3>& shifts) {
  std::array<std::uint32_t, 3> first;
  std::array<unsigned, 3> plain;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t c = classes[k];
    first[k] = c == kEscapeClass ? 0 : std::uint32_t{kClasses[c].first} << shifts[k];
    plain[k] = c == kEscapeClass ? 32 : kClasses[c].bits + shifts[k];
  }
  const bool at_once = plain[0] + plain[1] + plain[2] + 3 <= kWholeBits;
  Lattice residuals;
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == 0 || !at_once) bits = eight_bytes(plain_, bit_at_ >> 3) >> (bit_at_ & 7);
    const std::uint32_t magnitude = first[k] + static_cast<std::uint32_t>(bits & ((std::uint64_t{1} << plain[k]) - 1));
    bits >>= plain[k];
    const std::uint32_t has_sign = magnitude != 0;
    const std::uint32_t negative = 0u - (static_cast<std::uint32_t>(bits) & has_sign);
    bits >>= has_sign;
    bit_at_ += plain[k] + has_sign;
    residuals[k] = static_cast<std::int32_t>((magnitude ^ negative) - negative);
  }
  return residuals;
}

Lattice ResidualWriter::code(const Activity& activity, const Lattice& residuals) {
  for (std::size_t axis = 0; axis < 3; ++axis) write(axis, residual_context(activity[axis]), residuals[axis]);
  return residuals;
}

Lattice ResidualWriter::code_in(const std::array<unsigned, 3>& tables, const Lattice& residuals) {
  for (std::size_t axis = 0; axis < 3; ++axis) write(axis, {tables[axis], 0}, residuals[axis]);
  return residuals;
}

void ResidualWriter::write(std::size_t axis, const ResidualContext& context, std::int32_t residual) {
  const auto [table, shift] = context;
  const auto bits = static_cast<std::uint32_t>(residual);
  const std::uint32_t magnitude = residual < 0 ? 0u - bits : bits;
  const unsigned c = class_of(magnitude >> shift);
  ++statistics_.share(table, c).count;
  symbols_.push_back({static_cast<std::uint8_t>(axis), static_cast<std::uint8_t>(table), static_cast<std::uint8_t>(c)});
  if (c == kEscapeClass) {
    write_bits(magnitude, 32);
  } else {
    const MagnitudeClass& magnitude_class = kClasses[c];
    write_bits(magnitude - (std::uint32_t{magnitude_class.first} << shift), magnitude_class.bits + shift);
  }
  if (magnitude != 0) write_bits(residual < 0, 1);
}

std::vector<std::byte> ResidualWriter::finish() const {
  std::array<std::uint32_t, 3> states{1u << 16, 1u << 16, 1u << 16};
  std::vector<std::uint16_t> words;
  for (std::size_t i = symbols_.size(); i-- > 0;) {
    const auto [axis, table, c] = symbols_[i];
    const auto [frequency, start, count] = statistics_.share(table, c);
    std::uint32_t& state = states[axis];
    if (state >= std::uint64_t{frequency} << (32 - kFrequencyBits)) {
      words.push_back(static_cast<std::uint16_t>(state));
      state >>= 16;
    }
    state = (state / frequency << kFrequencyBits) + state % frequency + start;
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
