// SPDX-License-Identifier: Apache-2.0
// A priority queue of items 0..n-1, cheapest first, ties by item, for costs that mostly grow. Items wait in buckets by
// the leading bits of their cost; only the cheapest bucket is sorted, when its turn comes. An item that is pushed into
// a later bucket costs one write, whatever the size of the queue, and what comes next is known early enough to fetch
// it.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <functional>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

class CostQueue {
 public:
  explicit CostQueue(Index item_count) : buckets_(kBucketCount, kNone), next_(item_count, kNone), cost_(item_count) {}

  // Precondition: cost >= 0 and the item is not in the queue.
  void push(Index item, float cost) {
    assert(cost >= 0);
    const std::uint32_t bucket = bucket_of(cost);
    if (bucket <= current_) {
      late_.push_back(key(item, cost));
      std::push_heap(late_.begin(), late_.end(), std::greater<>());
      return;
    }
    cost_[item] = cost;
    next_[item] = buckets_[bucket];
    buckets_[bucket] = item;
  }

  // Makes front() and pop() valid; false when the queue is empty. Where items come out of a bucket, `reprice(item,
  // old)` gives their cost as it is now, not below the one they were pushed with, or a negative number to drop them;
  // `fetch(item)` is called some items ahead of it.
  template <class Reprice, class Fetch>
  bool advance(Reprice&& reprice, Fetch&& fetch) {
    while (sorted_.empty() && late_.empty()) {
      while (current_ < kBucketCount && buckets_[current_] == kNone) ++current_;
      if (current_ == kBucketCount) {
        current_ = 0;
        return false;
      }
      taken_.clear();
      for (Index item = buckets_[current_]; item != kNone; item = next_[item]) taken_.push_back(item);
      buckets_[current_] = kNone;
      constexpr std::size_t kAhead = 6;
      for (std::size_t i = 0; i < taken_.size(); ++i) {
        if (i + kAhead < taken_.size()) fetch(taken_[i + kAhead]);
        const Index item = taken_[i];
        const float cost = reprice(item, cost_[item]);
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
    return advance(reprice, [](Index) {});
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
  static constexpr int kDroppedBits = 18;  // of a float's 23 bits of mantissa: 32 buckets per power of two
  static constexpr std::uint32_t kBucketCount = 0x7f800000u >> kDroppedBits;

  // The bits of floats that are not negative are ordered as the floats are.
  static std::uint32_t bucket_of(float cost) {
    return std::min(std::bit_cast<std::uint32_t>(cost) >> kDroppedBits, kBucketCount - 1);
  }
  bool late_first() const { return !late_.empty() && (sorted_.empty() || late_.front() < sorted_.back()); }
  static std::uint64_t key(Index item, float cost) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32 | item;
  }

  std::vector<Index> buckets_;         // [kBucketCount]: the first item of a list
  std::vector<Index> next_;            // [item_count]
  std::vector<float> cost_;            // [item_count]
  std::vector<std::uint64_t> sorted_;  // the current bucket, cheapest last
  std::vector<std::uint64_t> late_;    // a heap: what was pushed into the current bucket or an earlier one
  std::vector<Index> taken_;           // scratch
  std::uint32_t current_ = 0;          // the bucket that is in sorted_
};

}  // namespace limber
