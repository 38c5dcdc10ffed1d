// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

// Calls body(first, end) for ranges that cover 0 .. count once, on so many threads, >= 1.
template <class Body>
void for_ranges(Index count, unsigned threads, const Body& body) {
  constexpr Index kGrain = 1024;
  std::atomic<Index> next{0};
  const auto work = [&] {
    for (Index first; (first = next.fetch_add(kGrain, std::memory_order_relaxed)) < count;)
      body(first, std::min(first + kGrain, count));
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads && i * kGrain < count; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

}  // namespace limber
