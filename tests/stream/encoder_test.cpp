// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/encoder.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "limber/stream/crc32c.h"
#include "tests/stream/sample_clip.h"

namespace limber::test {
namespace {

Encoder encoder_into_nothing() {
  return Encoder([](std::span<const std::byte>) { return Result<void>(); });
}

TEST(Encoder, WritesTheSameBytesAgain) {
  const SampleClip clip = rough_clip(5);
  EXPECT_EQ(encode(clip, {}), encode(clip, {}));
}

// The value is the same for every compiler and machine; it changes only with the format or the encoder's choices.
TEST(Encoder, WritesTheSameBytesOnEveryMachine) {
  const auto bytes = encode(sample_clip(grid(20, 20), grouped(400, 5, 3), 6), {.key_interval = 4});
  EXPECT_EQ(crc32c(bytes), 839738373u) << bytes.size();
}

TEST(Encoder, MakesKeysAtTheIntervalAndOnRequest) {
  const SampleClip clip = rough_clip(8);
  std::vector<std::byte> bytes;
  Encoder encoder([&bytes](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return Result<void>();
  });
  ASSERT_TRUE(encoder.begin(clip.mesh, clip.frames[0].hierarchy, clip.first_positions(), {.key_interval = 4}));
  for (std::size_t f = 0; f < 8; ++f) {
    const SampleFrame& frame = clip.frames[f];
    ASSERT_TRUE(encoder.add(frame.hierarchy, frame.swaps, frame.positions, frame.errors, {}, f == 2));
  }
  ASSERT_TRUE(encoder.finish());
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  std::vector<std::uint32_t> keys;
  for (std::uint32_t f = 0; f < 8; ++f) keys.push_back(decoder.key_at_or_before(f));
  EXPECT_EQ(keys, (std::vector<std::uint32_t>{0, 0, 2, 2, 2, 2, 6, 6}));
  EXPECT_EQ(play(decoder).size(), 8u);
}

// Nodes may glide in x and y, but not in z.
TEST(Encoder, SavesBytesWhereNodesHaveLeeway) {
  const SampleClip clip = sample_clip(grid(20, 20), grouped(400, 5, 3), 6);
  const Hierarchy& hierarchy = clip.frames[0].hierarchy;
  const std::vector<Leeway> leeways(hierarchy.node_count() - hierarchy.vertex_count(),
                                    {.xx = 1.0f, .yy = 1.0f, .zz = 1e6f});
  std::vector<std::byte> bytes;
  Encoder encoder([&bytes](std::span<const std::byte> more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
    return Result<void>();
  });
  ASSERT_TRUE(encoder.begin(clip.mesh, hierarchy, clip.first_positions(), {}));
  for (const SampleFrame& frame : clip.frames)
    ASSERT_TRUE(encoder.add(frame.hierarchy, frame.swaps, frame.positions, frame.errors, leeways));
  ASSERT_TRUE(encoder.finish());
  EXPECT_LT(bytes.size(), encode(clip, {}).size());

  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  const auto states = play(decoder);
  ASSERT_EQ(states.size(), clip.frames.size());
  const double tolerance = decoder.header().tolerance;
  double farthest = 0;
  for (std::size_t f = 0; f < states.size(); ++f) {
    for (Index node = 0; node < hierarchy.node_count(); ++node) {
      const Vec3d d = Vec3d(states[f].positions[node]) - Vec3d(clip.frames[f].positions[node]);
      EXPECT_TRUE(node >= hierarchy.vertex_count() || length(d) <= tolerance);
      EXPECT_LE(std::fabs(d.z), 1e-3 + tolerance);
      farthest = std::max(farthest, length(d));
    }
  }
  EXPECT_GT(farthest, tolerance);
}

TEST(Encoder, RefusesAPositionThatIsNotFinite) {
  SampleClip clip = rough_clip(1);
  Encoder encoder = encoder_into_nothing();
  ASSERT_TRUE(encoder.begin(clip.mesh, clip.frames[0].hierarchy, clip.first_positions(), {}));
  clip.frames[0].positions[4].y = std::numeric_limits<float>::quiet_NaN();
  const SampleFrame& frame = clip.frames[0];
  const auto added = encoder.add(frame.hierarchy, {}, frame.positions, frame.errors);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(added.error().where, "frame 0, node 4");
}

TEST(Encoder, RefusesAPositionSoFarThatTheToleranceCannotBeKept) {
  SampleClip clip = rough_clip(1);
  Encoder encoder = encoder_into_nothing();
  ASSERT_TRUE(encoder.begin(clip.mesh, clip.frames[0].hierarchy, clip.first_positions(), {}));
  clip.frames[0].positions[0].x = 1e30f;
  const SampleFrame& frame = clip.frames[0];
  const auto added = encoder.add(frame.hierarchy, {}, frame.positions, frame.errors);
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, ErrorCode::kUnsupported);
}

TEST(Encoder, RefusesToFinishWithAnotherNumberOfFramesThanAnnounced) {
  const SampleClip clip = rough_clip(1);
  Encoder encoder = encoder_into_nothing();
  ASSERT_TRUE(encoder.begin(clip.mesh, clip.frames[0].hierarchy, clip.first_positions(), {.frame_count = 2}));
  const SampleFrame& frame = clip.frames[0];
  ASSERT_TRUE(encoder.add(frame.hierarchy, {}, frame.positions, frame.errors));
  const auto finished = encoder.finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().code, ErrorCode::kMismatch);
}

TEST(Encoder, PassesOnTheErrorOfItsSink) {
  const SampleClip clip = rough_clip(1);
  Encoder encoder([](std::span<const std::byte>) { return Result<void>(Error{ErrorCode::kIo, "disk", "full"}); });
  const auto begun = encoder.begin(clip.mesh, clip.frames[0].hierarchy, clip.first_positions(), {});
  ASSERT_FALSE(begun);
  EXPECT_EQ(begun.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace limber::test
