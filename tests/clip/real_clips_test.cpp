// SPDX-License-Identifier: Apache-2.0
// The real clips, with the counts that their index gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/clip/clip.h"
#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"
#include "tests/support/data.h"

namespace limber {
namespace {

struct Counts {
  Index vertices = 0;
  std::size_t triangles = 0;
  std::uint32_t frames = 0;
};

// Reads all frames and compares the counts; gives the positions of the last frame.
void expect_counts(const std::string& specification, const Counts& expected, std::uint32_t first_number = 0) {
  const auto clip = open_clip(specification, {});
  ASSERT_DONE(clip);
  EXPECT_EQ((*clip)->mesh().vertex_count, expected.vertices);
  EXPECT_EQ((*clip)->mesh().triangles.size(), expected.triangles);
  EXPECT_EQ((*clip)->frame_count(), expected.frames);
  EXPECT_EQ((*clip)->first_frame_number(), first_number);
  std::vector<Vec3f> positions((*clip)->mesh().vertex_count);
  std::uint32_t frames = 0;
  while (true) {
    const Result<bool> more = (*clip)->read(positions);
    ASSERT_DONE(more);
    if (!*more) break;
    ++frames;
  }
  EXPECT_EQ(frames, expected.frames);
}

TEST(RealClips, HorseGallopIsAFolderOfPaddedNumbers) {
  LIMBER_DATA_SET(folder, "horse-gallop");
  for (const auto& path : {folder, folder / "%04d.obj", folder / "*.obj"}) {
    expect_counts(path.string(), {8431, 16843, 48}, 1);
  }
}

TEST(RealClips, HorseCollapseIsAFolderOfNumbersWithoutZeros) {
  LIMBER_DATA_SET(folder, "horse-collapse");
  expect_counts(folder.string(), {8431, 16843, 53}, 1);
  // Natural order: frame 2 is 2.obj, not 10.obj.
  const auto clip = open_clip((folder / "*.obj").string(), {});
  const Result<MeshFile> second = read_mesh(folder / "2.obj");
  ASSERT_TRUE(clip && second);
  std::vector<Vec3f> positions(8431);
  ASSERT_DONE((*clip)->read(positions));
  ASSERT_DONE((*clip)->read(positions));
  EXPECT_EQ(positions, second->positions);
}

TEST(RealClips, WalkingCatIsMadeOfPolygons) {
  LIMBER_DATA_SET(folder, "walking-cat");
  expect_counts(folder.string(), {1297, 2576, 35}, 1);
}

TEST(RealClips, PointCachesFindTheirMesh) {
  const std::vector<std::tuple<std::string, Counts, std::uint32_t>> expected{{"elephant-gallop", {42321, 84638, 24}, 0},
                                                                             {"crane", {10002, 20000, 60}, 0},
                                                                             {"pcow", {2904, 5804, 204}, 0},
                                                                             {"chickenCrossing", {3030, 5664, 400}, 0},
                                                                             {"cloth-drop", {10201, 20000, 60}, 1},
                                                                             {"ocean", {21025, 41472, 30}, 1},
                                                                             {"ict-face", {26719, 52220, 24}, 0},
                                                                             {"cat-poses", {7207, 14410, 9}, 0},
                                                                             {"face-poses", {29299, 57836, 9}, 0}};
  std::size_t found = 0;
  for (const auto& [name, counts, first_number] : expected) {
    const auto folder = test::data_set(name);
    if (!folder) continue;
    ++found;
    SCOPED_TRACE(name);
    expect_counts((*folder / "anim.pc2").string(), counts, first_number);
    expect_counts(folder->string(), counts, first_number);
  }
  if (found == 0) GTEST_SKIP() << "no point cache is unpacked; see ./test";
}

TEST(RealClips, RemeshedCamelIsRefusedForItsConnectivity) {
  LIMBER_DATA_SET(folder, "remeshed-camel");
  const auto clip = open_clip(folder.string(), {});
  ASSERT_DONE(clip);
  EXPECT_ERROR(test::read_all(**clip), kMismatch,
               "camel-gallop-02.off: has 5001 vertices and 10000 triangles, but the first frame, camel-gallop-01.off, "
               "has 4999 and 10000");
}

TEST(RealClips, SurviveTheWayThroughEveryFormat) {
  LIMBER_DATA_SET(folder, "walking-cat");
  const test::ScratchFolder scratch;
  std::string source = folder.string();
  for (const std::string name : {"a.mdd", "ply/%02d.ply", "b.pc2", "off/%02d.off"}) {
    const auto clip = open_clip(source, {});
    ASSERT_DONE(clip);
    const auto frames = test::read_all(**clip);
    ASSERT_DONE(frames);
    const auto writer =
        create_clip(scratch / name, (*clip)->mesh(), {.first_frame_number = (*clip)->first_frame_number()});
    ASSERT_DONE(writer);
    for (const auto& frame : *frames) ASSERT_DONE((*writer)->write(frame));
    ASSERT_DONE((*writer)->finish());
    source = scratch / name;
  }
  const auto original = open_clip(folder.string(), {});
  const auto copy = open_clip(source, {});
  ASSERT_TRUE(original && copy);
  EXPECT_EQ((*copy)->mesh(), (*original)->mesh());
  EXPECT_EQ((*copy)->first_frame_number(), 1u);
  EXPECT_EQ(*test::read_all(**copy), *test::read_all(**original));
}

}  // namespace
}  // namespace limber
