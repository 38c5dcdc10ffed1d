// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/point_cache_reader.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "tests/clip/point_caches.h"
#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

constexpr std::endian kLittle = std::endian::little;

std::string pc2(std::uint32_t frames, float start = 0) {
  return test::pc2_header(4, frames, 1, start) + test::four_points<kLittle>(frames);
}

std::string mdd() { return test::mdd_header(4, {0, 0.1f, 0.2f}) + test::four_points<std::endian::big>(3); }

TEST(PointCacheReader, ReadsBothKinds) {
  const test::ScratchFolder folder;
  folder.write("a.obj", test::tetrahedron_obj());
  folder.write("a.pc2", pc2(3));
  folder.write("b.mdd", mdd());
  for (const std::string name : {"a.pc2", "b.mdd"}) {
    const auto clip = open_clip(folder / name, {});
    ASSERT_DONE(clip);
    EXPECT_EQ((*clip)->mesh(), test::tetrahedron());
    EXPECT_EQ((*clip)->frame_count(), 3u);
    EXPECT_EQ((*clip)->frames_per_second(), name == "a.pc2" ? 24.0 : 10.0);
    for (int pass = 0; pass < 2; ++pass) {
      const auto frames = test::read_all(**clip);
      ASSERT_DONE(frames);
      ASSERT_EQ(frames->size(), 3u);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ((*frames)[i], std::vector<Vec3f>(4, Vec3f{static_cast<float>(i), 0, -1}));
      }
      ASSERT_DONE((*clip)->rewind());
    }
  }
}

TEST(PointCacheReader, ReadsFramesFromFirstToLastByTheNumbersOfTheFile) {
  const test::ScratchFolder folder;
  folder.write("a.obj", test::tetrahedron_obj());
  const std::string path = folder.write("a.pc2", pc2(6, 10));
  const auto clip = open_clip(path, {.first = 12, .last = 13});
  ASSERT_DONE(clip);
  EXPECT_EQ((*clip)->first_frame_number(), 12u);
  EXPECT_EQ((*clip)->frame_count(), 2u);
  const auto frames = test::read_all(**clip);
  ASSERT_DONE(frames);
  ASSERT_EQ(frames->size(), 2u);
  EXPECT_EQ((*frames)[0][0].x, 2.0f);
  EXPECT_EQ((*frames)[1][0].x, 3.0f);
  EXPECT_ERROR(open_clip(path, {.first = 9}), kNotFound, "there is no frame 9: the frames are numbered from 10 to 15");
  EXPECT_ERROR(open_clip(path, {.last = 16}), kNotFound, "there is no frame 16");
}

TEST(PointCacheReader, TakesTheMeshOfTheSameNameOrTheOnlyOne) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("a.pc2", pc2(1));
  folder.write("base.obj", test::tetrahedron_obj());
  EXPECT_TRUE(open_clip(path, {}));
  folder.write("other.ply", "");
  EXPECT_ERROR(open_clip(path, {}), kBadInput, "several mesh files are beside it (base.obj, other.ply)");
  EXPECT_TRUE(open_clip(path, {.mesh = folder / "base.obj"}));
  folder.write("a.obj", test::tetrahedron_obj());
  EXPECT_TRUE(open_clip(path, {}));
}

TEST(PointCacheReader, RefusesACacheWithoutItsMesh) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("a.pc2", pc2(1));
  EXPECT_ERROR(open_clip(path, {}), kNotFound, "no mesh file is beside it; name it with --mesh");
  EXPECT_ERROR(open_clip(path, {.mesh = folder / "none.obj"}), kNotFound, "none.obj: no such file");
  for (int i = 0; i < 10; ++i) folder.write(std::to_string(i) + ".obj", "");
  EXPECT_ERROR(open_clip(path, {}), kBadInput, "(0.obj, 1.obj, 2.obj, 3.obj, 4.obj, 5.obj, 6.obj, 7.obj and 2 more)");
}

TEST(PointCacheReader, RefusesAMeshOfAnotherVertexCount) {
  const test::ScratchFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_ERROR(open_clip(folder.write("a.pc2", pc2(1)), {}), kMismatch, "a.pc2: moves 4 points, but its mesh");
}

TEST(PointCacheReader, RefusesAPositionThatIsNotFinite) {
  const test::ScratchFolder folder;
  folder.write("a.obj", test::tetrahedron_obj());
  std::string bytes = pc2(2);
  bytes.replace(32 + 48 + 12 + 4, 4, test::bytes_of<kLittle>(std::numeric_limits<float>::infinity()));
  const auto clip = open_clip(folder.write("a.pc2", bytes), {});
  ASSERT_DONE(clip);
  EXPECT_ERROR(test::read_all(**clip), kBadInput,
               "a.pc2, frame 1, byte 92: the position of vertex 1 (counted from 0) is not finite");
}

TEST(PointCacheReader, RefusesAFileThatBecomesShorterWhileItIsRead) {
  const test::ScratchFolder folder;
  folder.write("a.obj", test::tetrahedron_obj());
  const std::string path = folder.write("a.pc2", pc2(2));
  const auto clip = open_clip(path, {});
  ASSERT_DONE(clip);
  std::filesystem::resize_file(path, 100);
  EXPECT_ERROR(test::read_all(**clip), kTruncated, "a.pc2, byte 100: the file ends here");
}

TEST(PointCacheReader, ReadsBeyondFourGigabytes) {
  const test::ScratchFolder folder;
  folder.write("a.obj", test::tetrahedron_obj());
  constexpr std::uint32_t kFrames = 100'000'000;
  const std::string path = folder.write("a.pc2", test::pc2_header(4, kFrames));
  std::error_code error;
  std::filesystem::resize_file(path, 32 + 48ull * kFrames, error);
  if (error) GTEST_SKIP() << "no sparse file of 4.8 GB can be made here: " << error.message();
  std::fstream(path, std::ios::binary | std::ios::in | std::ios::out)
      .seekp(32 + 48ll * (kFrames - 1))
      .write(test::four_points<kLittle>(2).substr(48).data(), 48);
  const auto clip = open_clip(path, {.first = kFrames - 1});
  ASSERT_DONE(clip);
  const auto frames = test::read_all(**clip);
  ASSERT_DONE(frames);
  ASSERT_EQ(frames->size(), 1u);
  EXPECT_EQ(frames->front(), std::vector<Vec3f>(4, Vec3f{1, 0, -1}));
}

}  // namespace
}  // namespace limber
