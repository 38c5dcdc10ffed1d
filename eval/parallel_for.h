// SPDX-License-Identifier: Apache-2.0
// The one door to parallel loops. oneTBB runs them; under the thread sanitizer plain threads do, because Debian's
// oneTBB is not built with it, so that what its scheduler orders would look like races.
#pragma once

#include <cstddef>

#if defined(__SANITIZE_THREAD__)
#define LIMBER_PLAIN_THREADS 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define LIMBER_PLAIN_THREADS 1
#endif
#endif

#ifdef LIMBER_PLAIN_THREADS
#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace limber::eval {

// Calls body(first, end) for ranges that cover 0 .. count once, in any order, several at the same time. A range longer
// than `grain` (>= 1) may be divided.
template <class Body>
void parallel_for_ranges(std::size_t count, std::size_t grain, const Body& body) {
#ifdef LIMBER_PLAIN_THREADS
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    // Relaxed: a counter that orders the bodies would hide their races.
    for (std::size_t first; (first = next.fetch_add(grain, std::memory_order_relaxed)) < count;)
      body(first, std::min(first + grain, count));
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < 4 && i * grain < count; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
#else
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
#endif
}

// Calls body(i) for every i of 0 .. count once, in any order, several at the same time.
template <class Body>
void parallel_for(std::size_t count, const Body& body) {
  parallel_for_ranges(count, 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) body(i);
  });
}

}  // namespace limber::eval

#undef LIMBER_PLAIN_THREADS
