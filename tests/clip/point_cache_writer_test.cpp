// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/point_cache_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/point_caches.h"
#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Result<void> write_frames(ClipWriter& writer, std::uint32_t count) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (auto done = writer.write(std::vector<Vec3f>(4, Vec3f{static_cast<float>(i), 0, -1})); !done) return done;
  }
  return {};
}

TEST(PointCacheWriter, WritesPc2AsSpecified) {
  const test::ScratchFolder folder;
  const auto writer = create_clip(folder / "a.pc2", test::tetrahedron(), {.first_frame_number = 5});
  ASSERT_DONE(writer);
  ASSERT_DONE(write_frames(**writer, 3));
  ASSERT_DONE((*writer)->finish());
  EXPECT_EQ(folder.read("a.pc2"), test::pc2_header(4, 3, 1, 5) + test::four_points<std::endian::little>(3));
  EXPECT_THAT(folder.names(), ElementsAre("a.obj", "a.pc2"));
}

TEST(PointCacheWriter, WritesMddAsSpecified) {
  const test::ScratchFolder folder;
  const auto writer =
      create_clip(folder / "a.mdd", test::tetrahedron(), {.first_frame_number = 5, .frames_per_second = 10});
  ASSERT_DONE(writer);
  ASSERT_DONE(write_frames(**writer, 3));
  ASSERT_DONE((*writer)->finish());
  EXPECT_EQ(folder.read("a.mdd"), test::mdd_header(4, {0.5f, 0.6f, 0.7f}) + test::four_points<std::endian::big>(3));
  EXPECT_THAT(folder.names(), ElementsAre("a.mdd", "a.obj"));
}

TEST(PointCacheWriter, LeavesNothingBehindBeforeItFinishes) {
  for (const std::string name : {"a.pc2", "a.mdd"}) {
    const test::ScratchFolder folder;
    {
      const auto writer = create_clip(folder / name, test::tetrahedron(), {});
      ASSERT_DONE(writer);
      ASSERT_DONE(write_frames(**writer, 2));
    }
    EXPECT_THAT(folder.names(), IsEmpty());
    {
      const auto writer = create_clip(folder / name, test::tetrahedron(), {});
      ASSERT_DONE(writer);
      EXPECT_ERROR((*writer)->finish(), kBadInput, "there are no frames to write");
    }
    EXPECT_THAT(folder.names(), IsEmpty());
  }
}

TEST(PointCacheWriter, RefusesAnExistingCacheOrMesh) {
  const test::ScratchFolder folder;
  folder.write("a.pc2", "old");
  folder.write("b.obj", "old");
  EXPECT_ERROR(create_clip(folder / "a.pc2", test::tetrahedron(), {}), kExists, "a.pc2: is already there");
  EXPECT_ERROR(create_clip(folder / "b.mdd", test::tetrahedron(), {}), kExists, "b.obj: is already there");
  EXPECT_THAT(folder.names(), ElementsAre("a.pc2", "b.obj"));
  const auto writer = create_clip(folder / "b.mdd", test::tetrahedron(), {.replace = true});
  ASSERT_DONE(writer);
  ASSERT_DONE(write_frames(**writer, 1));
  ASSERT_DONE((*writer)->finish());
  EXPECT_TRUE(open_clip(folder / "b.mdd", {}));
}

TEST(PointCacheWriter, LeavesNoMeshWhereTheCacheCannotHaveItsName) {
  const test::ScratchFolder folder;
  {
    const auto writer = create_clip(folder / "a.pc2", test::tetrahedron(), {});
    ASSERT_DONE(writer);
    ASSERT_DONE(write_frames(**writer, 1));
    folder.write("a.pc2", "other");
    EXPECT_ERROR((*writer)->finish(), kExists, "a.pc2");
  }
  EXPECT_THAT(folder.names(), ElementsAre("a.pc2"));
}

}  // namespace
}  // namespace limber
