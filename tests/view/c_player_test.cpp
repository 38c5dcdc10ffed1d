// SPDX-License-Identifier: Apache-2.0
// How bytes arrive at the C interface, and what it refuses.
#include "tests/view/c_player.h"

#include <algorithm>
#include <cstddef>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vector>

#include "limber/player.h"
#include "tests/view/player_stream.h"

namespace limber {
namespace {

using test::by_vertices;
using test::Bytes;
using test::cut_now;
using test::Drawn;
using test::info_of;
using test::kFrameCount;
using test::make_stream;
using test::new_player;
using test::OwnedCut;
using test::OwnedPlayer;
using test::play_in_cpp;
using test::player_of;
using testing::HasSubstr;

TEST(CPlayer, MeetsEveryFrameWhileBytesArriveOneAtATime) {
  const Bytes bytes = make_stream();
  const std::vector<Drawn> expected = play_in_cpp(bytes, {.by = CutBy::kVertices, .budget = 60});
  const OwnedPlayer player = new_player();
  const OwnedCut cut(limber_cut_create(player.get()));
  std::vector<Drawn> frames;
  for (const std::byte& one : bytes) {
    ASSERT_LE(limber_append(player.get(), &one, 1), LIMBER_NEEDS_MORE) << limber_error(player.get());
    while (limber_step(player.get()) == LIMBER_OK) frames.push_back(cut_now(cut.get(), by_vertices(60)));
  }
  EXPECT_EQ(frames, expected);
  EXPECT_EQ(info_of(player).has_index, 0u);
  EXPECT_EQ(info_of(player).frame_count, kFrameCount);
}

TEST(CPlayer, SaysWhatItNeedsAndIsHappyWithThatAlone) {
  const Bytes bytes = make_stream();
  const std::vector<Drawn> expected = play_in_cpp(bytes, {.by = CutBy::kVertices, .budget = 60, .hysteresis = 1});
  for (const std::uint32_t target : {0u, 6u, 14u, 22u, 3u}) {
    const OwnedPlayer player = new_player();
    ASSERT_EQ(limber_set_size(player.get(), bytes.size()), LIMBER_NEEDS_MORE);
    limber_range range;
    std::uint64_t fetched = 0;
    std::size_t requests = 0;
    while (limber_missing(player.get(), target, &range) == LIMBER_NEEDS_MORE) {
      ASSERT_GT(range.size, 0u);
      ASSERT_LE(limber_supply(player.get(), range.offset, bytes.data() + range.offset, range.size), LIMBER_NEEDS_MORE);
      fetched += range.size;
      ++requests;
    }
    EXPECT_LE(requests, 6u);
    ASSERT_EQ(limber_seek(player.get(), target), LIMBER_OK);
    const OwnedCut cut(limber_cut_create(player.get()));
    limber_cut_options options = by_vertices(60);
    options.hysteresis = 1;
    EXPECT_EQ(cut_now(cut.get(), options), expected[target]);
    const limber_info info = info_of(player);
    EXPECT_EQ(info.has_index, 1u);
    EXPECT_EQ(info.available_frames, kFrameCount);
    EXPECT_EQ(info.bytes_there, fetched);
    EXPECT_LT(fetched, bytes.size() * 2 / 3);

    limber_frame frame = LIMBER_FRAME_INIT;
    ASSERT_EQ(limber_get_frame(player.get(), target, &frame), LIMBER_OK);
    EXPECT_EQ(frame.key, target / test::kKeyInterval * test::kKeyInterval);
    EXPECT_EQ(frame.is_there, 1u);
    // Another key's frames are not there, and asking for them changes nothing.
    const std::uint32_t elsewhere = target < 12 ? 20 : 1;
    EXPECT_EQ(limber_seek(player.get(), elsewhere), LIMBER_NEEDS_MORE);
    EXPECT_EQ(limber_shown_frame(player.get()), target);
  }
}

TEST(CPlayer, TakesTheRestInAnyOrder) {
  const Bytes bytes = make_stream();
  const std::vector<Drawn> expected = play_in_cpp(bytes, {.by = CutBy::kVertices, .budget = 60});
  test::Random random(4);
  const OwnedPlayer player = new_player();
  const std::size_t head = bytes.size() / 3;
  ASSERT_EQ(limber_append(player.get(), bytes.data(), head), LIMBER_OK);
  ASSERT_EQ(limber_set_size(player.get(), bytes.size()), LIMBER_OK);
  while (info_of(player).bytes_there < bytes.size()) {
    const std::uint32_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
    const std::size_t size = std::min<std::size_t>(random.below(900), bytes.size() - at);
    ASSERT_EQ(limber_supply(player.get(), at, bytes.data() + at, size), LIMBER_OK) << limber_error(player.get());
  }
  EXPECT_EQ(info_of(player).has_index, 1u);
  const OwnedCut cut(limber_cut_create(player.get()));
  for (const Drawn& frame : expected) {
    ASSERT_EQ(limber_step(player.get()), LIMBER_OK);
    ASSERT_EQ(cut_now(cut.get(), by_vertices(60)), frame);
  }
}

TEST(CPlayer, GoesOnWithoutAnIndexWhereTheEndIsSomethingElse) {
  Bytes bytes = make_stream();
  bytes.pop_back();
  const OwnedPlayer player = new_player();
  ASSERT_LE(limber_set_size(player.get(), bytes.size()), LIMBER_NEEDS_MORE);
  limber_range range;
  while (limber_missing(player.get(), 20, &range) == LIMBER_NEEDS_MORE) {
    const std::uint64_t size = std::min<std::uint64_t>(range.size, 700);
    ASSERT_LE(limber_supply(player.get(), range.offset, bytes.data() + range.offset, size), LIMBER_NEEDS_MORE);
  }
  EXPECT_EQ(limber_seek(player.get(), 20), LIMBER_OK) << limber_error(player.get());
}

TEST(CPlayer, LeavesMembersAloneThatAnOlderCallerDoesNotHave) {
  const OwnedPlayer player = player_of(make_stream());
  limber_info info = LIMBER_INFO_INIT;
  info.struct_size = offsetof(limber_info, available_frames);
  info.available_frames = 4711;
  ASSERT_EQ(limber_get_info(player.get(), &info), LIMBER_OK);
  EXPECT_EQ(info.frame_count, kFrameCount);
  EXPECT_EQ(info.available_frames, 4711u);
  EXPECT_EQ(info.struct_size, offsetof(limber_info, available_frames));

  const OwnedCut cut(limber_cut_create(player.get())), other(limber_cut_create(player.get()));
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  options.level = 1;
  const Drawn expected = cut_now(cut.get(), options);
  options.struct_size = offsetof(limber_cut_options, budget);
  options.hysteresis = -1;
  EXPECT_EQ(cut_now(other.get(), options), expected);
}

TEST(CPlayer, RefusesWrongCallsAndGoesOn) {
  const Bytes bytes = make_stream();
  const OwnedPlayer player = new_player();
  const OwnedCut cut(limber_cut_create(player.get()));
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  limber_mesh mesh = LIMBER_MESH_INIT;
  limber_info info = LIMBER_INFO_INIT;
  EXPECT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_NEEDS_MORE);
  EXPECT_EQ(limber_get_info(player.get(), &info), LIMBER_NEEDS_MORE);
  EXPECT_EQ(limber_step(player.get()), LIMBER_NEEDS_MORE);
  EXPECT_EQ(limber_supply(player.get(), 0, bytes.data(), 1), LIMBER_WRONG_CALL);
  EXPECT_THAT(limber_error(player.get()), HasSubstr("limber_set_size"));
  EXPECT_EQ(limber_append(player.get(), nullptr, 1), LIMBER_WRONG_CALL);
  EXPECT_EQ(limber_set_size(player.get(), bytes.size()), LIMBER_NEEDS_MORE);
  EXPECT_EQ(limber_set_size(player.get(), bytes.size()), LIMBER_WRONG_CALL);
  EXPECT_EQ(limber_supply(player.get(), bytes.size(), bytes.data(), 1), LIMBER_WRONG_CALL);
  EXPECT_EQ(limber_append(player.get(), bytes.data(), bytes.size()), LIMBER_OK);
  EXPECT_EQ(limber_append(player.get(), bytes.data(), 1), LIMBER_WRONG_CALL);
  EXPECT_EQ(limber_seek(player.get(), kFrameCount), LIMBER_WRONG_CALL);
  options.by = 99;
  EXPECT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_WRONG_CALL);
  options = LIMBER_CUT_DEFAULTS;
  options.hysteresis = 0.5f;
  EXPECT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_WRONG_CALL);
  options = LIMBER_CUT_DEFAULTS;
  options.error_bound = -1;
  EXPECT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_WRONG_CALL);
  options = LIMBER_CUT_DEFAULTS;
  mesh.struct_size = 0;
  EXPECT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_WRONG_CALL);
  mesh = LIMBER_MESH_INIT;
  EXPECT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
  limber_player_destroy(nullptr);
  limber_cut_destroy(nullptr);
}

TEST(CPlayer, SaysAtOnceThatSomethingElseIsNoStream) {
  const OwnedPlayer player = new_player();
  EXPECT_EQ(limber_append(player.get(), "<!doctype html>", 15), LIMBER_BAD_STREAM);
  EXPECT_THAT(limber_error(player.get()), HasSubstr("not a .limber stream"));
  EXPECT_EQ(limber_append(player.get(), "x", 1), LIMBER_BAD_STREAM);
  EXPECT_THAT(limber_error(player.get()), HasSubstr("not a .limber stream"));
  limber_range range;
  EXPECT_EQ(limber_missing(player.get(), 0, &range), LIMBER_BAD_STREAM);

  const Bytes bytes = make_stream();
  const OwnedPlayer ends_early = new_player();
  EXPECT_EQ(limber_set_size(ends_early.get(), 200), LIMBER_NEEDS_MORE);
  EXPECT_EQ(limber_append(ends_early.get(), bytes.data(), 200), LIMBER_NEEDS_MORE);
  EXPECT_EQ(limber_missing(ends_early.get(), 0, &range), LIMBER_BAD_STREAM);
  EXPECT_THAT(limber_error(ends_early.get()), HasSubstr("ends before its first frame"));
}

// Feeds bytes by what limber_missing() asks for, or in order, and plays whatever there is.
void play_hostile(const Bytes& bytes, bool by_ranges) {
  const OwnedPlayer player = new_player();
  const OwnedCut cut(limber_cut_create(player.get()));
  limber_cut_options options = by_vertices(60);
  options.fetch = LIMBER_FETCH_LEVELS | LIMBER_FETCH_ERRORS | LIMBER_FETCH_MOVED;
  if (by_ranges) {
    limber_set_size(player.get(), bytes.size());
    for (const std::uint32_t frame : {LIMBER_NONE, 8u, 21u}) {
      limber_range range;
      for (int i = 0; i < 12 && limber_missing(player.get(), frame, &range) == LIMBER_NEEDS_MORE; ++i) {
        ASSERT_GT(range.size, 0u);
        ASSERT_LE(range.offset + range.size, bytes.size());
        limber_supply(player.get(), range.offset, bytes.data() + range.offset, range.size);
      }
      limber_seek(player.get(), frame);
    }
  } else {
    limber_append(player.get(), bytes.data(), bytes.size());
  }
  for (std::uint32_t frame = 0; frame < kFrameCount; ++frame) {
    const limber_status status = limber_seek(player.get(), frame);
    limber_mesh mesh = LIMBER_MESH_INIT;
    if (status == LIMBER_OK) {
      ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
    } else {
      ASSERT_STRNE(limber_error(player.get()), "");
    }
  }
}

TEST(CPlayer, SurvivesEveryLengthAndAFlipOfEveryByte) {
  const Bytes bytes = make_stream();
  for (std::size_t size = 0; size < bytes.size(); size += size < 600 ? 1 : 61) {
    const Bytes cut_short(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    play_hostile(cut_short, false);
    play_hostile(cut_short, true);
  }
  for (std::size_t at = 0; at < bytes.size(); at += at < 600 || at + 400 > bytes.size() ? 1 : 59) {
    Bytes flipped = bytes;
    flipped[at] ^= static_cast<std::byte>(1u << at % 8);
    play_hostile(flipped, false);
    play_hostile(flipped, true);
  }
}

TEST(CPlayer, ShowsNothingAfterADamagedFrameAndRecoversAtAKey) {
  Bytes bytes = make_stream();
  limber_frame frame = LIMBER_FRAME_INIT;
  ASSERT_EQ(limber_get_frame(player_of(bytes).get(), 3, &frame), LIMBER_OK);
  bytes[frame.offset + frame.size / 2] ^= std::byte{4};
  const OwnedPlayer player = player_of(bytes);
  EXPECT_EQ(limber_seek(player.get(), 4), LIMBER_BAD_STREAM);
  EXPECT_THAT(limber_error(player.get()), HasSubstr("frame 3, byte"));
  EXPECT_EQ(limber_shown_frame(player.get()), LIMBER_NONE);
  EXPECT_EQ(limber_seek(player.get(), 8), LIMBER_OK);
}

}  // namespace
}  // namespace limber
