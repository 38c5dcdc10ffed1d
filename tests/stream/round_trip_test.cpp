// SPDX-License-Identifier: Apache-2.0
// decode(encode(x)) = x, on every way through a stream.
#include <bit>
#include <gtest/gtest.h>
#include <limits>

#include "tests/stream/sample_clip.h"

namespace limber::test {
namespace {

void expect_frames(const SampleClip& clip, const std::vector<FrameState>& states, double tolerance) {
  ASSERT_EQ(states.size(), clip.frames.size());
  for (std::size_t f = 0; f < states.size(); ++f) {
    EXPECT_EQ(states[f].frame, f);
    EXPECT_EQ(states[f].hierarchy, clip.frames[f].hierarchy);
    for (std::size_t node = 0; node < states[f].positions.size(); ++node) {
      const Vec3f &was = clip.frames[f].positions[node], &is = states[f].positions[node];
      ASSERT_LE(length(Vec3d(was) - Vec3d(is)), tolerance) << "frame " << f << ", node " << node;
      ASSERT_NEAR(states[f].errors[node], clip.frames[f].errors[node], clip.frames[f].errors[node] / 16);
    }
  }
}

void expect_round_trip(const SampleClip& clip, const EncoderOptions& options = {.key_interval = 4}) {
  const auto bytes = encode(clip, options);
  Decoder decoder;
  const auto opened = decoder.open(bytes);
  ASSERT_TRUE(opened) << opened.error().line();
  EXPECT_EQ(decoder.mesh(), clip.mesh);
  EXPECT_EQ(decoder.frame_count(), clip.frames.size());
  expect_frames(clip, play(decoder), decoder.header().tolerance);
}

TEST(RoundTrip, OfARoughMesh) { expect_round_trip(rough_clip(11)); }

TEST(RoundTrip, OfAGridWithFourLevels) { expect_round_trip(sample_clip(grid(12, 9), grouped(108, 4, 4), 6)); }

TEST(RoundTrip, OfOneFrame) { expect_round_trip(rough_clip(1)); }

TEST(RoundTrip, OfASingleTriangle) { expect_round_trip(sample_clip({3, {{2, 0, 1}}}, grouped(3, 2, 2), 3)); }

TEST(RoundTrip, OfOneLevelOnly) { expect_round_trip(sample_clip(grid(4, 4), grouped(16, 4, 1), 3)); }

TEST(RoundTrip, OfVerticesWithoutTriangles) { expect_round_trip(sample_clip({7, {}}, grouped(7, 3, 2), 3)); }

TEST(RoundTrip, OfASingleVertexWithoutExtent) { expect_round_trip(sample_clip({1, {}}, grouped(1, 2, 2), 3)); }

TEST(RoundTrip, OfAlternatingKeys) { expect_round_trip(rough_clip(5), {.key_interval = 1}); }

SampleClip emptied_clusters() {
  SampleClip clip{grid(4, 2), {}};
  Hierarchy hierarchy = grouped(8, 2, 3);
  const std::vector<std::vector<Swap>> swaps{{}, {{0, 9}, {1, 9}}, {{2, 8}}, {{8, 13}, {9, 13}}, {{4, 11}}, {{2, 9}}};
  for (std::size_t f = 0; f < swaps.size(); ++f) {
    for (const Swap& swap : swaps[f]) apply(hierarchy, swap);
    clip.frames.push_back({hierarchy, swaps[f], {}, {}});
    move_nodes(clip.frames.back(), static_cast<Index>(f), 4);
    for (Index node = 8; node < hierarchy.node_count(); ++node) clip.frames.back().positions[node].z += 3.0f;
  }
  return clip;
}

TEST(RoundTrip, OfClustersThatLoseAllTheirChildren) { expect_round_trip(emptied_clusters()); }

TEST(RoundTrip, KeepsTheToleranceAtEveryScaleAndFarFromTheOrigin) {
  for (const float scale : {1e-38f, 1e-20f, 1e-3f, 1.0f, 1e4f, 1e20f, 1e30f}) {
    for (const float shift : {0.0f, 3.0f, 1000.0f, 300000.0f}) {
      for (const double tolerance : {1e-6, 1.0 / 20000, 0.1}) {
        SampleClip clip = rough_clip(4);
        for (SampleFrame& frame : clip.frames)
          for (Vec3f& p : frame.positions) p = (p + Vec3f{shift, 0, -shift}) * scale;
        SCOPED_TRACE(testing::Message() << scale << ' ' << shift << ' ' << tolerance);
        expect_round_trip(clip, {.tolerance = tolerance});
      }
    }
  }
}

TEST(RoundTrip, LosslessKeepsEveryBit) {
  SampleClip clip = rough_clip(6);
  using Limits = std::numeric_limits<float>;
  const float odd[] = {-0.0f, 0.0f, Limits::denorm_min(), -Limits::denorm_min(), Limits::max(), -Limits::max(), 1e-40f};
  for (std::size_t f = 0; f < clip.frames.size(); ++f)
    for (std::size_t i = 0; i < std::size(odd); ++i)
      clip.frames[f].positions[i + f] = {odd[i], odd[(i + f) % std::size(odd)], 1.0f};
  const auto bytes = encode(clip, {.lossless = true, .key_interval = 4});
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  EXPECT_EQ(decoder.header().step, 0.0);
  const auto states = play(decoder);
  ASSERT_EQ(states.size(), clip.frames.size());
  for (std::size_t f = 0; f < states.size(); ++f)
    for (std::size_t node = 0; node < states[f].positions.size(); ++node)
      for (float Vec3f::*k : {&Vec3f::x, &Vec3f::y, &Vec3f::z})
        ASSERT_TRUE(same_bits(states[f].positions[node].*k, clip.frames[f].positions[node].*k));
}

void expect_same_from_any_key(const SampleClip& clip, std::uint32_t key_interval) {
  const auto bytes = encode(clip, {.key_interval = key_interval});
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  const auto played = play(decoder);
  ASSERT_EQ(played.size(), clip.frames.size());
  for (std::uint32_t target = 0; target < played.size(); ++target) {
    Decoder other;
    ASSERT_TRUE(other.open(bytes));
    FrameState state;
    other.prepare(state);
    for (std::uint32_t frame = other.key_at_or_before(target); frame <= target; ++frame)
      ASSERT_TRUE(other.decode(frame, state));
    EXPECT_TRUE(same_state(state, played[target])) << "frame " << target;
  }
}

TEST(RoundTrip, FromAnyKeyGivesTheSameAsFromTheStart) { expect_same_from_any_key(rough_clip(12), 5); }

TEST(RoundTrip, FromAnyKeyGivesTheSameWhereClustersAreEmpty) { expect_same_from_any_key(emptied_clusters(), 2); }

TEST(RoundTrip, GivesTheSwapsThatLeadFromFrameToFrame) {
  const SampleClip clip = rough_clip(7);
  const auto bytes = encode(clip, {.key_interval = 5});
  Decoder decoder;
  ASSERT_TRUE(decoder.open(bytes));
  const auto states = play(decoder);
  ASSERT_EQ(states.size(), 7u);
  for (std::size_t f = 0; f < 7; ++f) {
    if (decoder.is_key(static_cast<std::uint32_t>(f))) {
      EXPECT_TRUE(states[f].swaps.empty());
      continue;
    }
    Hierarchy replayed = states[f - 1].hierarchy;
    for (const Swap& swap : states[f].swaps) apply(replayed, swap);
    EXPECT_EQ(replayed, clip.frames[f].hierarchy);
    EXPECT_EQ(states[f].swaps.size(), clip.frames[f].swaps.size());
  }
}

}  // namespace
}  // namespace limber::test
