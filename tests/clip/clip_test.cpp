// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/clip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/point_caches.h"
#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Clip, EveryFormatReadsBackWhatItWrote) {
  const Mesh mesh = test::awkward_mesh();
  for (const std::string name : {"%03d.obj", "f%d.ply", "f%d.off", "out.pc2", "out.mdd"}) {
    const test::ScratchFolder folder;
    const auto writer = create_clip(folder / name, mesh, {.first_frame_number = 98, .frames_per_second = 25});
    ASSERT_DONE(writer);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
      ASSERT_DONE((*writer)->write(test::awkward_positions(mesh.vertex_count, frame)));
    }
    ASSERT_DONE((*writer)->finish());
    const auto clip = open_clip(folder / name, {});
    ASSERT_DONE(clip);
    EXPECT_EQ((*clip)->mesh(), mesh);
    EXPECT_EQ((*clip)->frame_count(), 4u);
    EXPECT_EQ((*clip)->first_frame_number(), 98u) << name;
    EXPECT_EQ((*clip)->frames_per_second(), name == "out.mdd" ? 25.0 : 24.0);
    const auto frames = test::read_all(**clip);
    ASSERT_DONE(frames);
    ASSERT_EQ(frames->size(), 4u);
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
      EXPECT_EQ((*frames)[frame], test::awkward_positions(mesh.vertex_count, frame)) << name;
    }
  }
}

TEST(Clip, OpensASequenceByPatternGlobAndFolder) {
  const test::ScratchFolder folder;
  for (int i = 8; i < 12; ++i) folder.write(std::to_string(i) + ".obj", test::tetrahedron_obj(std::to_string(i)));
  for (const std::string& specification : {folder / "%d.obj", folder / "*.obj", folder.path().string()}) {
    const auto clip = open_clip(specification, {.first = 9});
    ASSERT_DONE(clip);
    EXPECT_EQ((*clip)->frame_count(), 3u);
    EXPECT_EQ((*clip)->first_frame_number(), 9u);
    const auto frames = test::read_all(**clip);
    ASSERT_DONE(frames);
    EXPECT_EQ((*frames)[1][0].x, 10.0f);
  }
}

TEST(Clip, OpensASingleMeshAsAClipOfOneFrame) {
  const test::ScratchFolder folder;
  const auto clip = open_clip(folder.write("100%d [1]*.obj", test::tetrahedron_obj()), {});
  ASSERT_DONE(clip);
  EXPECT_EQ((*clip)->frame_count(), 1u);
  EXPECT_EQ((*clip)->first_frame_number(), 0u);
}

TEST(Clip, OpensAFolderThatHoldsAPointCacheAndItsMesh) {
  const test::ScratchFolder folder;
  folder.write("base.obj", test::tetrahedron_obj());
  folder.write("anim.pc2", test::pc2_header(4, 2) + test::four_points<std::endian::little>(2));
  const auto clip = open_clip(folder.path().string(), {});
  ASSERT_DONE(clip);
  EXPECT_EQ((*clip)->frame_count(), 2u);
  folder.write("other.mdd", "");
  EXPECT_ERROR(open_clip(folder.path().string(), {}), kBadInput, "holds several point caches");
}

TEST(Clip, RefusesWhatIsNoClip) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(open_clip("", {}), kNotFound, "no such file or folder");
  EXPECT_ERROR(open_clip(folder / "none.obj", {}), kNotFound, "none.obj: no such file or folder");
  EXPECT_ERROR(open_clip(folder.write("a.stl", "solid"), {}), kUnsupported,
               "the extensions are .obj .ply .off .pc2 .mdd");
  EXPECT_ERROR(open_clip(folder.path().string(), {}), kNotFound, "has no mesh files");
  EXPECT_ERROR(open_clip(std::string(100000, 'a'), {}), kNotFound, "no such file or folder");
  EXPECT_ERROR(open_clip(folder.write("e.obj", ""), {}), kTruncated, "e.obj: the file is empty");
}

TEST(Clip, RefusesToWriteWhatIsNoClip) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(create_clip(folder / "a.stl", test::tetrahedron(), {}), kUnsupported,
               "is no kind of clip that limber writes");
  EXPECT_ERROR(create_clip(folder / "none/a.pc2", test::tetrahedron(), {}), kNotFound, "there is no folder");
}

TEST(Clip, WritesOneFrameToANameWithoutANumber) {
  const test::ScratchFolder folder;
  {
    const auto writer = create_clip(folder / "a.obj", test::tetrahedron(), {});
    ASSERT_DONE(writer);
    ASSERT_DONE((*writer)->write(test::awkward_positions(4, 0)));
    EXPECT_ERROR((*writer)->write(test::awkward_positions(4, 1)), kBadInput, "a file holds one frame");
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Clip, LeavesAnExistingSequenceAloneUntilTheNewOneIsWhole) {
  const test::ScratchFolder folder;
  folder.write("0.obj", "old");
  EXPECT_ERROR(create_clip(folder / "%d.obj", test::tetrahedron(), {}), kExists, "0.obj: is already there");
  {
    const auto writer = create_clip(folder / "%d.obj", test::tetrahedron(), {.replace = true});
    ASSERT_DONE(writer);
    ASSERT_DONE((*writer)->write(test::awkward_positions(4, 0)));
  }
  EXPECT_THAT(folder.names(), ElementsAre("0.obj"));
  EXPECT_EQ(folder.read("0.obj"), "old");
}

std::vector<std::vector<Vec3f>> all_frames(const ClipOptions& options) {
  const auto reader = open_clip("sample:flag?vertices=300&frames=8", options);
  EXPECT_TRUE(reader);
  std::vector<std::vector<Vec3f>> frames;
  std::vector<Vec3f> positions((*reader)->mesh().vertex_count);
  while (*(*reader)->read(positions)) frames.push_back(positions);
  EXPECT_EQ((*reader)->frame_count(), frames.size());
  EXPECT_TRUE((*reader)->rewind());
  EXPECT_TRUE(*(*reader)->read(positions));
  EXPECT_EQ(positions, frames.front());
  return frames;
}

TEST(OpenClip, GivesEveryNthFrame) {
  const auto all = all_frames({});
  for (const std::uint32_t step : {1u, 2u, 3u, 7u, 8u, 100u}) {
    std::vector<std::vector<Vec3f>> expected;
    for (std::size_t i = 1; i < all.size(); i += step) expected.push_back(all[i]);
    EXPECT_EQ(all_frames({.first = 1, .step = step}), expected) << step;
  }
}

TEST(OpenClip, LowersTheRateWithTheStep) {
  const auto all = open_clip("sample:flag?vertices=300&frames=8", {});
  const auto some = open_clip("sample:flag?vertices=300&frames=8", {.step = 4});
  EXPECT_EQ(4 * (*some)->frames_per_second(), (*all)->frames_per_second());
}

}  // namespace
}  // namespace limber
