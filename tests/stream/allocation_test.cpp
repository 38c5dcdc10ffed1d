// SPDX-License-Identifier: Apache-2.0
// Replaces operator new for the whole program: counts while it is told to.
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>

#include "tests/stream/sample_clip.h"

namespace {

bool counting = false;
int allocation_count = 0;

}  // namespace

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (counting) ++allocation_count;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* memory = operator new(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace limber::test {
namespace {

TEST(Allocation, DecodingAllocatesNothingAfterPrepare) {
  const SampleClip clip = rough_clip(9);
  const auto bytes = encode(clip, {.key_interval = 4});
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  FrameState state;
  decoder.prepare(state);
  allocation_count = 0;
  counting = true;
  bool decoded = true;
  for (const std::uint32_t frame : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 4u, 5u, 0u, 8u})
    decoded = static_cast<bool>(decoder.decode(frame, state)) && decoded;
  counting = false;
  EXPECT_TRUE(decoded);
  EXPECT_EQ(allocation_count, 0);
}

TEST(Allocation, AnnouncingMuchInFewBytesAllocatesLittle) {
  auto bytes = encode(rough_clip(1), {});
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  // A mesh chunk that is cut short, with counts in the header that fit their limits, is refused before
  // anything is made for it; decoder_test.cpp has the cases one by one.
  allocation_count = 0;
  counting = true;
  const bool opened = static_cast<bool>(decoder.open(std::span(bytes).first(bytes.size() / 4)));
  counting = false;
  EXPECT_FALSE(opened);
  EXPECT_LT(allocation_count, 20);
}

}  // namespace
}  // namespace limber::test
