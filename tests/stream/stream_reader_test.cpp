// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/stream_reader.h"

#include <gtest/gtest.h>

#include "limber/clip/sample.h"
#include "limber/stream/build_stream.h"

namespace limber {
namespace {

class StreamReader : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = open_sample("sample:flag?vertices=200&frames=9");
    ASSERT_TRUE(opened);
    clip_ = std::move(*opened);
    BuildStreamOptions options;
    options.encoder.lossless = true;
    options.encoder.key_interval = 4;
    ASSERT_TRUE(build_stream(*clip_, options, [this](std::span<const std::byte> more) {
      bytes_.insert(bytes_.end(), more.begin(), more.end());
      return Result<void>();
    }));
    ASSERT_TRUE(clip_->rewind());
  }

  void expect_frames(ClipReader& reader, std::uint32_t begin, std::uint32_t end) {
    std::vector<Vec3f> expected(clip_->mesh().vertex_count), read(reader.mesh().vertex_count);
    ASSERT_TRUE(clip_->rewind());
    for (std::uint32_t frame = 0; frame < end; ++frame) {
      ASSERT_TRUE(clip_->read(expected));
      if (frame < begin) continue;
      const auto more = reader.read(read);
      ASSERT_TRUE(more && *more);
      EXPECT_EQ(read, expected) << frame;
    }
    const auto more = reader.read(read);
    ASSERT_TRUE(more);
    EXPECT_FALSE(*more);
  }

  std::unique_ptr<ClipReader> clip_;
  std::vector<std::byte> bytes_;
};

TEST_F(StreamReader, GivesTheFramesOfTheClip) {
  auto reader = open_stream_clip(bytes_, {}, "x");
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->mesh(), clip_->mesh());
  EXPECT_EQ((*reader)->frame_count(), 9u);
  expect_frames(**reader, 0, 9);
  ASSERT_TRUE((*reader)->rewind());
  expect_frames(**reader, 0, 9);
}

TEST_F(StreamReader, StartsInTheMiddle) {
  auto reader = open_stream_clip(bytes_, {.mesh = {}, .first = 6, .last = 7}, "x");
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->frame_count(), 2u);
  EXPECT_EQ((*reader)->first_frame_number(), 6u);
  expect_frames(**reader, 6, 8);
}

TEST_F(StreamReader, RefusesFramesThatAreNotThere) {
  const auto reader = open_stream_clip(bytes_, {.mesh = {}, .first = {}, .last = 9}, "x");
  ASSERT_FALSE(reader);
  EXPECT_EQ(reader.error().code, ErrorCode::kNotFound);
}

TEST_F(StreamReader, AStreamThatEndsEarlyIsAnErrorAfterItsLastWholeFrame) {
  bytes_.resize(bytes_.size() * 2 / 3);
  auto reader = open_stream_clip(bytes_, {}, "x");
  ASSERT_TRUE(reader);
  std::vector<Vec3f> positions(clip_->mesh().vertex_count);
  Result<bool> more = true;
  int frames = 0;
  for (; more && *more && frames < 9; ++frames) more = (*reader)->read(positions);
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().code, ErrorCode::kTruncated);
}

}  // namespace
}  // namespace limber
