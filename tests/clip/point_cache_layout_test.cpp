// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/point_cache_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/point_caches.h"
#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

Result<PointCacheLayout> layout_of(const std::string& bytes, PointCacheFormat format) {
  const test::ScratchFolder folder;
  Result<InputFile> file = InputFile::open(folder.write("a.cache", bytes));
  if (!file) return file.error();
  return read_point_cache_layout(*file, format);
}

TEST(Pc2Layout, IsThatOfTheHeader) {
  const auto layout = layout_of(test::pc2_header(5, 2) + std::string(120, '\0'), PointCacheFormat::kPc2);
  ASSERT_DONE(layout);
  EXPECT_EQ(layout->point_count, 5u);
  EXPECT_EQ(layout->frame_count, 2u);
  EXPECT_EQ(layout->frame_offset(1), 32u + 60u);
  EXPECT_EQ(layout->first_frame_number, 0u);
  EXPECT_EQ(layout->frames_per_second, 24.0);
}

TEST(Pc2Layout, NumbersFramesFromAWholeStart) {
  const std::string body(12, '\0');
  EXPECT_EQ(layout_of(test::pc2_header(1, 1, 1, 7.0f) + body, PointCacheFormat::kPc2)->first_frame_number, 7u);
  EXPECT_EQ(layout_of(test::pc2_header(1, 1, 1, 7.5f) + body, PointCacheFormat::kPc2)->first_frame_number, 0u);
  EXPECT_EQ(layout_of(test::pc2_header(1, 1, 1, -7.0f) + body, PointCacheFormat::kPc2)->first_frame_number, 0u);
  EXPECT_EQ(layout_of(test::pc2_header(1, 1, 1, 7.0f, 0.5f) + body, PointCacheFormat::kPc2)->first_frame_number, 0u);
}

TEST(Pc2Layout, RefusesOtherFilesAndVersions) {
  EXPECT_ERROR(layout_of(std::string(100, 'x'), PointCacheFormat::kPc2), kBadInput, "must start with POINTCACHE2");
  EXPECT_ERROR(layout_of(test::pc2_header(1, 1, 2) + std::string(12, '\0'), PointCacheFormat::kPc2), kUnsupported,
               "is PC2 of version 2");
  EXPECT_ERROR(layout_of(test::pc2_header(0, 1), PointCacheFormat::kPc2), kBadInput,
               "its header gives 0 points and 1 frames");
  EXPECT_ERROR(layout_of(test::pc2_header(1, 0), PointCacheFormat::kPc2), kBadInput,
               "its header gives 1 points and 0 frames");
  EXPECT_ERROR(layout_of(test::pc2_header(0xffffffff, 1), PointCacheFormat::kPc2), kBadInput, "gives -1 points");
}

TEST(Pc2Layout, NamesFrameAndByteWhereATruncatedFileEnds) {
  EXPECT_ERROR(layout_of(test::pc2_header(2, 3) + std::string(71, '\0'), PointCacheFormat::kPc2), kTruncated,
               "a.cache, frame 2, byte 103: the file ends here, but its header promises 3 frames of 2 points");
  EXPECT_ERROR(layout_of(test::pc2_header(0x7fffffff, 0x7fffffff), PointCacheFormat::kPc2), kTruncated,
               "frame 0, byte 32");
  EXPECT_ERROR(layout_of(test::pc2_header(2, 3).substr(0, 20), PointCacheFormat::kPc2), kTruncated, "a.cache, byte 20");
  EXPECT_ERROR(layout_of("", PointCacheFormat::kPc2), kTruncated, "the file is empty");
}

TEST(Pc2Layout, RefusesBytesAfterTheLastFrame) {
  EXPECT_ERROR(layout_of(test::pc2_header(2, 3) + std::string(73, '\0'), PointCacheFormat::kPc2), kBadInput,
               "a.cache, byte 104: the file goes on after the 3 frames of 2 points");
}

TEST(MddLayout, TakesRateAndFirstNumberFromTheTimes) {
  const auto layout =
      layout_of(test::mdd_header(2, {0.4f, 0.44f, 0.48f}) + std::string(72, '\0'), PointCacheFormat::kMdd);
  ASSERT_DONE(layout);
  EXPECT_EQ(layout->point_count, 2u);
  EXPECT_EQ(layout->frame_count, 3u);
  EXPECT_EQ(layout->data_offset, 20u);
  EXPECT_EQ(layout->frames_per_second, 25.0);
  EXPECT_EQ(layout->first_frame_number, 10u);
}

TEST(MddLayout, IsTwentyFourFramesPerSecondWhereTheTimesSayNothing) {
  for (const std::vector<float>& times :
       {std::vector<float>{0, 0}, {1, 0}, {0, std::numeric_limits<float>::infinity()}, {0}}) {
    const auto layout =
        layout_of(test::mdd_header(1, times) + std::string(12 * times.size(), '\0'), PointCacheFormat::kMdd);
    ASSERT_DONE(layout);
    EXPECT_EQ(layout->frames_per_second, 24.0);
    EXPECT_EQ(layout->first_frame_number, 0u);
  }
}

TEST(MddLayout, RefusesTruncatedFilesAndEmptyClips) {
  const std::string whole = test::mdd_header(2, {0, 1, 2}) + std::string(72, '\0');
  EXPECT_ERROR(layout_of(whole.substr(0, 50), PointCacheFormat::kMdd), kTruncated,
               "frame 1, byte 50: the file ends here");
  EXPECT_ERROR(layout_of(whole.substr(0, 10), PointCacheFormat::kMdd), kTruncated, "frame 0, byte 10");
  EXPECT_ERROR(layout_of(whole.substr(0, 7), PointCacheFormat::kMdd), kTruncated, "byte 7");
  EXPECT_ERROR(layout_of(whole + "x", PointCacheFormat::kMdd), kBadInput, "the file goes on");
  EXPECT_ERROR(layout_of(std::string(8, '\0'), PointCacheFormat::kMdd), kBadInput, "gives 0 points and 0 frames");
  EXPECT_ERROR(layout_of(std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff", 8), PointCacheFormat::kMdd), kTruncated,
               "frame 0");
}

}  // namespace
}  // namespace limber
