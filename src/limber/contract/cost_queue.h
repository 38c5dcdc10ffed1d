// SPDX-License-Identifier: Apache-2.0
// A priority queue of items, cheapest first, ties by item, for costs that mostly grow. Items wait in buckets by the
// leading bits of their cost; only the cheapest bucket is sorted, when its turn comes. An item that is pushed into a
// later bucket costs one write, whatever the size of the queue, and what comes next is known early enough to fetch it.
// A bucket is a list of chunks, so that taking it reads memory in few places.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

class CostQueue {
 public:
  // item_count: about how many items will be in it at once. buckets_per_double: a power of two, at most 32: for costs
  // of which one is twice the other.
  explicit CostQueue(Index item_count, unsigned buckets_per_double = 32)
      : dropped_bits_(kMantissaBits - std::countr_zero(buckets_per_double)), buckets_(bucket_count(), kNone) {
    assert(std::has_single_bit(buckets_per_double) && buckets_per_double <= 32);
    chunks_.reserve(item_count / kChunkSize + 64);
  }

  // Precondition: cost >= 0.
  void push(Index item, float cost) {
    assert(cost >= 0);
    const std::uint32_t bucket = bucket_of(cost);
    if (bucket <= current_) {
      late_.push_back(key(item, cost));
      std::push_heap(late_.begin(), late_.end(), std::greater<>());
      return;
    }
    Index& first = buckets_[bucket];
    if (first == kNone || chunks_[first].count == kChunkSize) first = new_chunk(first);
    Chunk& chunk = chunks_[first];
    chunk.keys[chunk.count++] = key(item, cost);
  }

  // Makes front() and pop() valid; false when the queue is empty. Where items come out of a bucket, `reprice(item,
  // old)` gives their cost as it is now, not below the one they were pushed with, or a negative number to drop them;
  // `fetch_early(item)` and `fetch_late(item)` are called some items ahead of that.
  template <class Reprice, class FetchEarly, class FetchLate>
  bool advance(Reprice&& reprice, FetchEarly&& fetch_early, FetchLate&& fetch_late) {
    while (sorted_.empty() && late_.empty()) {
      while (current_ < bucket_count() && buckets_[current_] == kNone) ++current_;
      if (current_ == bucket_count()) {
        current_ = 0;
        return false;
      }
      take(current_);
      constexpr std::size_t kEarly = 16, kLate = 8;
      for (std::size_t i = 0; i < std::min(kEarly, taken_.size()); ++i) fetch_early(static_cast<Index>(taken_[i]));
      for (std::size_t i = 0; i < std::min(kLate, taken_.size()); ++i) fetch_late(static_cast<Index>(taken_[i]));
      for (std::size_t i = 0; i < taken_.size(); ++i) {
        if (i + kEarly < taken_.size()) fetch_early(static_cast<Index>(taken_[i + kEarly]));
        if (i + kLate < taken_.size()) fetch_late(static_cast<Index>(taken_[i + kLate]));
        const auto item = static_cast<Index>(taken_[i]);
        const float cost = reprice(item, std::bit_cast<float>(static_cast<std::uint32_t>(taken_[i] >> 32)));
        if (cost < 0) continue;
        if (bucket_of(cost) <= current_)
          sorted_.push_back(key(item, cost));
        else
          push(item, cost);
      }
      std::sort(sorted_.begin(), sorted_.end(), std::greater<>());
    }
    return true;
  }

  template <class Reprice>
  bool advance(Reprice&& reprice) {
    return advance(
        reprice, [](Index) {}, [](Index) {});
  }

  // Precondition for both: advance() was true, and nothing has been popped since.
  Index front() const { return static_cast<Index>(late_first() ? late_.front() : sorted_.back()); }
  void pop() {
    if (late_first()) {
      std::pop_heap(late_.begin(), late_.end(), std::greater<>());
      late_.pop_back();
    } else {
      sorted_.pop_back();
    }
  }

  // An item that is likely to come `ahead` pops from now (0: the next); kNone if not known.
  Index upcoming(std::size_t ahead) const {
    return ahead < sorted_.size() ? static_cast<Index>(sorted_[sorted_.size() - 1 - ahead]) : kNone;
  }

 private:
  static constexpr int kMantissaBits = 23;  // of a float
  std::uint32_t bucket_count() const { return 0x7f800000u >> dropped_bits_; }

  static constexpr std::uint32_t kChunkSize = 15;
  struct Chunk {
    std::array<std::uint64_t, kChunkSize> keys;
    Index next, count;
  };

  // The bits of floats that are not negative are ordered as the floats are.
  std::uint32_t bucket_of(float cost) const {
    return std::min(std::bit_cast<std::uint32_t>(cost) >> dropped_bits_, bucket_count() - 1);
  }
  bool late_first() const { return !late_.empty() && (sorted_.empty() || late_.front() < sorted_.back()); }
  static std::uint64_t key(Index item, float cost) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32 | item;
  }

  Index new_chunk(Index next) {
    Index chunk = free_;
    if (chunk != kNone) {
      free_ = chunks_[chunk].next;
    } else {
      chunk = static_cast<Index>(chunks_.size());
      chunks_.emplace_back();
    }
    chunks_[chunk].next = next;
    chunks_[chunk].count = 0;
    return chunk;
  }

  // Empties a bucket into taken_.
  void take(std::uint32_t bucket) {
    taken_.clear();
    for (Index at = std::exchange(buckets_[bucket], kNone); at != kNone;) {
      Chunk& chunk = chunks_[at];
      taken_.insert(taken_.end(), chunk.keys.begin(), chunk.keys.begin() + chunk.count);
      const Index next = std::exchange(chunk.next, free_);
      free_ = std::exchange(at, next);
    }
  }

  int dropped_bits_;                   // of the mantissa
  std::vector<Index> buckets_;         // [bucket_count()]: the first chunk of a list, the only one that is not full
  std::vector<Chunk> chunks_;          // those of all buckets, and free ones
  Index free_ = kNone;                 // the first chunk of the list of free ones
  std::vector<std::uint64_t> sorted_;  // the current bucket, cheapest last
  std::vector<std::uint64_t> late_;    // a heap: what was pushed into the current bucket or an earlier one
  std::vector<std::uint64_t> taken_;   // scratch
  std::uint32_t current_ = 0;          // the bucket that is in sorted_
};

}  // namespace limber
