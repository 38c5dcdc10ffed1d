// SPDX-License-Identifier: Apache-2.0
// A priority queue of items 0..n-1, cheapest first, ties by item, for costs that mostly grow. Items wait in buckets by
// the leading bits of their cost; only the cheapest bucket is kept in order, in a small heap. An item that is pushed
// into a later bucket costs one write, whatever the size of the queue.
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
      heap_.push_back(key(item, cost));
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
      return;
    }
    cost_[item] = cost;
    next_[item] = buckets_[bucket];
    buckets_[bucket] = item;
  }

  // Makes front() and pop() valid; false when the queue is empty. Where items come out of a bucket, `reprice(item)`
  // gives their cost as it is now, not below the one they were pushed with, or a negative number to drop them.
  template <class Reprice>
  bool advance(Reprice&& reprice) {
    while (heap_.empty()) {
      while (current_ < kBucketCount && buckets_[current_] == kNone) ++current_;
      if (current_ == kBucketCount) {
        current_ = 0;
        return false;
      }
      Index item = buckets_[current_];
      buckets_[current_] = kNone;
      while (item != kNone) {
        const Index following = next_[item];
        const float cost = reprice(item, cost_[item]);
        if (cost >= 0 && bucket_of(cost) <= current_)
          heap_.push_back(key(item, cost));
        else if (cost >= 0)
          push(item, cost);
        item = following;
      }
      std::make_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
    return true;
  }

  // Precondition for both: advance() was true, and nothing has been popped since.
  Index front() const { return static_cast<Index>(heap_.front()); }
  void pop() {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    heap_.pop_back();
  }

 private:
  static constexpr int kDroppedBits = 18;  // of a float's 23 bits of mantissa: 32 buckets per power of two
  static constexpr std::uint32_t kBucketCount = 0x7f800000u >> kDroppedBits;

  // The bits of floats that are not negative are ordered as the floats are.
  static std::uint32_t bucket_of(float cost) {
    return std::min(std::bit_cast<std::uint32_t>(cost) >> kDroppedBits, kBucketCount - 1);
  }
  static std::uint64_t key(Index item, float cost) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32 | item;
  }

  std::vector<Index> buckets_;  // [kBucketCount]: the first item of a list
  std::vector<Index> next_;     // [item_count]
  std::vector<float> cost_;     // [item_count]
  std::vector<std::uint64_t> heap_;
  std::uint32_t current_ = 0;  // the bucket that is in the heap
};

}  // namespace limber
