// SPDX-License-Identifier: Apache-2.0
#include "limber/view/player.h"

#include <gtest/gtest.h>

#include "tests/view/allocations.h"
#include "tests/view/player_stream.h"

namespace limber {
namespace {

using test::Bytes;
using test::kFrameCount;
using test::make_stream;

void expect_same_frame(const FrameState& a, const FrameState& b) {
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.hierarchy, b.hierarchy);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.errors, b.errors);
  EXPECT_EQ(a.swaps, b.swaps);
}

std::vector<FrameState> play_all(const Bytes& bytes) {
  Player player;
  std::vector<FrameState> frames;
  EXPECT_TRUE(player.open(bytes));
  frames.push_back(player.state());
  while (player.next_frame() < player.available_frames()) {
    EXPECT_TRUE(player.step());
    frames.push_back(player.state());
  }
  return frames;
}

TEST(Player, OpensAtFrameZeroAndStepsToTheLast) {
  const Bytes bytes = make_stream();
  Player player;
  ASSERT_TRUE(player.open(bytes));
  EXPECT_EQ(player.state().frame, 0u);
  EXPECT_EQ(player.available_frames(), kFrameCount);
  EXPECT_EQ(player.frame_count(), kFrameCount);
  for (std::uint32_t frame = 1; frame < kFrameCount; ++frame) {
    ASSERT_TRUE(player.step());
    ASSERT_EQ(player.state().frame, frame);
  }
}

TEST(Player, SeekingAFrameFromAnyOtherEqualsPlayingToIt) {
  const Bytes bytes = make_stream();
  const std::vector<FrameState> frames = play_all(bytes);
  ASSERT_EQ(frames.size(), kFrameCount);
  Player player;
  ASSERT_TRUE(player.open(bytes));
  for (std::uint32_t from = 0; from < kFrameCount; ++from) {
    for (std::uint32_t to = 0; to < kFrameCount; ++to) {
      ASSERT_TRUE(player.seek(from));
      ASSERT_TRUE(player.seek(to));
      expect_same_frame(player.state(), frames[to]);
    }
  }
}

TEST(Player, DoesNotAllocateAfterOpening) {
  const Bytes bytes = make_stream();
  Player player;
  ASSERT_TRUE(player.open(bytes));
  const std::size_t before = test::allocation_count();
  for (std::uint32_t frame = 1; frame < kFrameCount; ++frame) ASSERT_TRUE(player.step());
  for (std::uint32_t frame = kFrameCount; frame-- > 0;) ASSERT_TRUE(player.seek(frame));
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(Player, GoesOnWhileTheStreamArrives) {
  const Bytes bytes = make_stream();
  const std::vector<FrameState> frames = play_all(bytes);
  Player player;
  bool open = false;
  std::uint32_t shown = 0;
  for (std::size_t size = 0; size <= bytes.size(); size += size < 400 ? 1 : 97) {
    const Bytes arrived(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    if (!open) {
      const Result<void> opened = player.open(arrived);
      open = bool{opened};
      if (!open) {
        ASSERT_EQ(opened.error().code, ErrorCode::kTruncated);
        continue;
      }
    } else {
      ASSERT_TRUE(player.extend(arrived));
    }
    ASSERT_EQ(player.state().frame == kNone, player.available_frames() == 0);
    while (player.next_frame() < player.available_frames()) ASSERT_TRUE(player.step());
    if (player.available_frames() > 0) {
      shown = player.state().frame;
      expect_same_frame(player.state(), frames[shown]);
    }
    ASSERT_TRUE(player.extend(bytes.size() == size ? std::span(bytes) : std::span(bytes).first(size)));
  }
  ASSERT_TRUE(player.extend(bytes));
  while (player.next_frame() < player.available_frames()) ASSERT_TRUE(player.step());
  expect_same_frame(player.state(), frames.back());
}

TEST(Player, ShowsNothingAfterADamagedFrameAndRecoversAtAKey) {
  const Bytes bytes = make_stream();
  const std::vector<FrameState> frames = play_all(bytes);
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  std::size_t damaged_count = 0;
  for (std::size_t at = bytes.size() / 2; at < bytes.size(); at += 53) {
    Bytes damaged = bytes;
    damaged[at] ^= std::byte{0x10};
    Player player;
    if (!player.open(damaged)) continue;
    for (std::uint32_t frame = 0; frame < player.available_frames(); ++frame) {
      if (player.seek(frame)) {
        expect_same_frame(player.state(), frames[frame]);
      } else {
        ++damaged_count;
        EXPECT_EQ(player.state().frame, kNone);
      }
    }
  }
  EXPECT_GT(damaged_count, 0u);
}

}  // namespace
}  // namespace limber
