// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/build_stream.h"

#include <gmock/gmock.h>

#include "limber/clip/sample.h"
#include "limber/stream/base_frames.h"
#include "limber/stream/decoder.h"
#include "tests/support/grid.h"

namespace limber {
namespace {

// Frames whose only vertex that counts moves along x: the number of the frame can be seen. Knows its length or not.
class CountingClip : public ClipReader {
 public:
  CountingClip(std::uint32_t count, bool is_known) : count_(count), is_known_(is_known) {}
  const Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint32_t> frame_count() const override { return is_known_ ? std::optional(count_) : std::nullopt; }
  Result<bool> read(std::span<Vec3f> positions) override {
    if (next_ == count_) return false;
    positions[0] = {static_cast<float>(next_++), 0, 0};
    positions[1] = {0, 1, 0};
    positions[2] = {0, 0, 1};
    return true;
  }
  Result<void> rewind() override {
    next_ = 0;
    return {};
  }

 private:
  Mesh mesh_{3, {{0, 1, 2}}};
  std::uint32_t count_, next_ = 0;
  bool is_known_;
};

std::vector<int> chosen(std::uint32_t count, bool is_known, std::uint32_t most) {
  CountingClip clip(count, is_known);
  const auto base = choose_base_frames(clip, most, {});
  std::vector<int> frames;
  if (base)
    for (const auto& positions : base->positions) frames.push_back(static_cast<int>(positions[0].x));
  return frames;
}

TEST(BaseFrames, SpreadFromTheFirstToTheLast) {
  EXPECT_THAT(chosen(9, true, 5), testing::ElementsAre(0, 2, 4, 6, 8));
  EXPECT_THAT(chosen(60, true, 4), testing::ElementsAre(0, 20, 39, 59));
}

TEST(BaseFrames, AreAllWhereThereAreNoMore) {
  EXPECT_THAT(chosen(3, true, 8), testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(chosen(3, false, 8), testing::ElementsAre(0, 1, 2));
}

TEST(BaseFrames, OfAClipOfUnknownLengthAreEvenlySpacedAndNeverMore) {
  EXPECT_THAT(chosen(9, false, 4), testing::ElementsAre(0, 4, 8));
  EXPECT_THAT(chosen(13, false, 4), testing::ElementsAre(0, 4, 8, 12));
  EXPECT_THAT(chosen(5, false, 2), testing::ElementsAre(0, 4));
  EXPECT_THAT(chosen(1000, false, 3), testing::ElementsAre(0, 512));
}

TEST(BaseFrames, OneIsTheFirst) {
  EXPECT_THAT(chosen(50, true, 1), testing::ElementsAre(0));
  EXPECT_THAT(chosen(50, false, 1), testing::ElementsAre(0));
}

struct Built {
  Result<BuildReport> report;
  std::vector<std::byte> bytes;
};

Built build(ClipReader& clip, const BuildStreamOptions& options, const BuildProgressFunction& progress = {}) {
  std::vector<std::byte> bytes;
  auto report = build_stream(
      clip, options,
      [&](std::span<const std::byte> more) {
        bytes.insert(bytes.end(), more.begin(), more.end());
        return Result<void>();
      },
      progress);
  return {std::move(report), std::move(bytes)};
}

TEST(BuildStream, OneThreadAndTwoThreadsGiveTheSameBytes) {
  auto clip = open_sample("sample:flag?vertices=300&frames=6");
  ASSERT_TRUE(clip);
  BuildStreamOptions options;
  const Built one = build(**clip, options);
  ASSERT_TRUE((*clip)->rewind());
  options.threads = 2;
  const Built two = build(**clip, options);
  ASSERT_TRUE(one.report && two.report);
  EXPECT_EQ(one.bytes, two.bytes);
  EXPECT_EQ(one.report->stream_bytes, one.bytes.size());
  EXPECT_EQ(one.report->frame_count, 6u);
}

// A sheet whose folds run along x, then from frame 4 on along y.
class TurningClip : public ClipReader {
 public:
  const Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint32_t> frame_count() const override { return 8; }
  Result<bool> read(std::span<Vec3f> positions) override {
    if (next_ == 8) return false;
    for (Index v = 0; v < mesh_.vertex_count; ++v) {
      const auto x = static_cast<float>(v % kSide), y = static_cast<float>(v / kSide);
      positions[v] = {x, y, 3 * std::sin((next_ < 4 ? x : y) + 0.01f * static_cast<float>(next_))};
    }
    ++next_;
    return true;
  }
  Result<void> rewind() override {
    next_ = 0;
    return {};
  }

 private:
  static constexpr Index kSide = 24;
  Mesh mesh_ = test::grid(kSide, kSide);
  std::uint32_t next_ = 0;
};

TEST(BuildStream, AJumpIsAKey) {
  TurningClip clip;
  const Built built = build(clip, {.base_frames = 1});
  ASSERT_TRUE(built.report) << built.report.error().line();
  EXPECT_EQ(built.report->restart_count, 1u);
  Decoder decoder;
  ASSERT_TRUE(decoder.open(built.bytes));
  std::vector<std::uint32_t> keys;
  for (std::uint32_t frame = 0; frame < 8; ++frame)
    if (decoder.is_key(frame)) keys.push_back(frame);
  EXPECT_THAT(keys, testing::ElementsAre(0, 4));
}

TEST(BuildStream, AClipOfUnknownLengthIsAnnouncedWithItsLength) {
  CountingClip clip(5, false);
  const Built built = build(clip, {});
  ASSERT_TRUE(built.report) << built.report.error().line();
  Decoder decoder;
  ASSERT_TRUE(decoder.open(built.bytes));
  EXPECT_EQ(decoder.header().frame_count, 5u);
}

TEST(BuildStream, AClipWithoutFramesIsRefused) {
  for (const bool is_known : {true, false}) {
    CountingClip clip(0, is_known);
    const Built built = build(clip, {});
    ASSERT_FALSE(built.report);
    EXPECT_EQ(built.report.error().code, ErrorCode::kBadInput);
  }
}

TEST(BuildStream, CanBeStoppedAtEveryStep) {
  for (int steps = 0;; ++steps) {
    ASSERT_LT(steps, 100);
    CountingClip clip(4, true);
    int left = steps;
    const Built built = build(clip, {}, [&left](const BuildProgress&) { return left-- > 0; });
    if (built.report) break;
    EXPECT_EQ(built.report.error().code, ErrorCode::kCancelled);
  }
}

TEST(BuildStream, PassesOnTheErrorOfTheSink) {
  CountingClip clip(4, true);
  BuildStreamOptions options;
  options.threads = 2;
  for (int calls = 0; calls < 12; ++calls) {
    ASSERT_TRUE(clip.rewind());
    int left = calls;
    const auto report = build_stream(clip, options, [&left](std::span<const std::byte>) -> Result<void> {
      if (left-- > 0) return {};
      return Error{ErrorCode::kIo, "disk", "is full"};
    });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().where, "disk");
  }
}

TEST(Spread, IsMeanAndTheValueThat95PercentDoNotExceed) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Spread s = spread(values);
  EXPECT_EQ(s.mean, 50.5);
  EXPECT_EQ(s.p95, 95);
  std::vector<double> none;
  EXPECT_EQ(spread(none).mean, 0);
}

}  // namespace
}  // namespace limber
