// SPDX-License-Identifier: Apache-2.0
#include "tests/clip/allocation_meter.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace limber::test {
namespace {

std::atomic<std::size_t> largest{0};

}  // namespace

void reset_largest_allocation() { largest = 0; }
std::size_t largest_allocation() { return largest; }

}  // namespace limber::test

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  limber::test::largest = std::max(limber::test::largest.load(), size);
  return std::malloc(std::max<std::size_t>(1, size));
}

void* operator new(std::size_t size) {
  if (void* memory = operator new(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
