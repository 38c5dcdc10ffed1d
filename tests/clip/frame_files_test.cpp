// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/frame_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

using testing::ElementsAre;

std::vector<std::string> names_of(const Result<FrameFiles>& files) {
  if (!files) return {files.error().line()};
  std::vector<std::string> names;
  for (const auto& path : files->paths) names.push_back(path.filename().string());
  return names;
}

void make(const test::ScratchFolder& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) folder.write(name, "x");
}

TEST(FramesOfPattern, AreInTheOrderOfTheirNumbers) {
  const test::ScratchFolder folder;
  make(folder, {"9.obj", "10.obj", "8.obj", "11.obj", "011.obj", "a.obj", "9.ply", "horse9.obj"});
  const Result<FrameFiles> files = frames_of_pattern(folder / "%d.obj", {});
  EXPECT_THAT(names_of(files), ElementsAre("8.obj", "9.obj", "10.obj", "11.obj"));
  EXPECT_EQ(files->first_number, 8u);
}

TEST(FramesOfPattern, AreThoseFromFirstToLast) {
  const test::ScratchFolder folder;
  make(folder, {"f001.ply", "f002.ply", "f003.ply", "f004.ply", "f006.ply"});
  const Result<FrameFiles> files = frames_of_pattern(folder / "f%03d.ply", {.first = 2, .last = 4});
  EXPECT_THAT(names_of(files), ElementsAre("f002.ply", "f003.ply", "f004.ply"));
  EXPECT_EQ(files->first_number, 2u);
}

TEST(FramesOfPattern, RefusesAGapAndNamesTheMissingFile) {
  const test::ScratchFolder folder;
  make(folder, {"f001.ply", "f002.ply", "f004.ply", "f4000000000.ply"});
  EXPECT_ERROR(frames_of_pattern(folder / "f%03d.ply", {}), kNotFound,
               "f003.ply: is missing: the frames are numbered from 1 to 4000000000");
  EXPECT_ERROR(frames_of_pattern(folder / "f%03d.ply", {.first = 3}), kNotFound, "f003.ply: is missing");
  EXPECT_ERROR(frames_of_pattern(folder / "f%03d.ply", {.last = 3}), kNotFound, "f003.ply: is missing");
}

TEST(FramesOfPattern, RefusesFramesBeyondTheFirstAndLast) {
  const test::ScratchFolder folder;
  make(folder, {"1.obj", "2.obj", "3.obj"});
  EXPECT_ERROR(frames_of_pattern(folder / "%d.obj", {.first = 0}), kNotFound,
               "there is no frame 0: the frames are numbered from 1 to 3");
  EXPECT_ERROR(frames_of_pattern(folder / "%d.obj", {.last = 4}), kNotFound, "there is no frame 4");
  EXPECT_ERROR(frames_of_pattern(folder / "%d.obj", {.first = 3, .last = 2}), kBadInput,
               "the first frame, 3, lies after the last, 2");
}

TEST(FramesOfPattern, RefusesAPatternThatFitsNothingOrIsNone) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(frames_of_pattern(folder / "%d.obj", {}), kNotFound, "%d.obj: no file fits this pattern");
  EXPECT_ERROR(frames_of_pattern(folder / "none/%d.obj", {}), kNotFound, "no such folder");
  EXPECT_ERROR(frames_of_pattern(folder / "%d.xyz", {}), kUnsupported, "frames must be .obj, .ply or .off files");
  EXPECT_ERROR(frames_of_pattern(folder / "%s.obj", {}), kBadInput, "a pattern needs one frame number");
}

TEST(FramesOfGlob, FindTheNumberThatChanges) {
  const test::ScratchFolder folder;
  make(folder, {"v2_9_lod1.obj", "v2_10_lod1.obj", "v2_11_lod1.obj", "other.obj", ".v2_12_lod1.obj", "v2_13.txt"});
  const Result<FrameFiles> files = frames_of_glob(folder / "v2_*", {});
  EXPECT_THAT(names_of(files), ElementsAre("v2_9_lod1.obj", "v2_10_lod1.obj", "v2_11_lod1.obj"));
  EXPECT_EQ(files->first_number, 9u);
}

TEST(FramesOfGlob, AreInNaturalOrderWhereMoreThanANumberChanges) {
  const test::ScratchFolder folder;
  make(folder, {"b1.obj", "a10.obj", "a9.obj"});
  const Result<FrameFiles> files = frames_of_glob(folder / "??*.obj", {});
  EXPECT_THAT(names_of(files), ElementsAre("a9.obj", "a10.obj", "b1.obj"));
  EXPECT_EQ(files->first_number, 0u);
  EXPECT_THAT(names_of(frames_of_glob(folder / "*.obj", {.first = 1, .last = 1})), ElementsAre("a10.obj"));
}

TEST(FramesOfGlob, MatchStarsAndQuestionMarks) {
  const test::ScratchFolder folder;
  make(folder, {"a1.obj", "a2.obj", "a22.obj", "ab2.obj"});
  EXPECT_THAT(names_of(frames_of_glob(folder / "a?.obj", {})), ElementsAre("a1.obj", "a2.obj"));
  EXPECT_THAT(names_of(frames_of_glob(folder / "*b*.o*j", {})), ElementsAre("ab2.obj"));
  EXPECT_THAT(names_of(frames_of_glob(folder / "**a*2.obj*", {})), ElementsAre("a2.obj", "a22.obj", "ab2.obj"));
}

TEST(FramesOfGlob, RefusesAGapAndNamesTheMissingFile) {
  const test::ScratchFolder folder;
  make(folder, {"f08.obj", "f09.obj", "f11.obj"});
  EXPECT_ERROR(frames_of_glob(folder / "f*.obj", {}), kNotFound, "f10.obj: is missing");
}

TEST(FramesOfGlob, RefusesTwoFilesOfOneNumber) {
  const test::ScratchFolder folder;
  make(folder, {"1.obj", "01.obj", "2.obj"});
  EXPECT_ERROR(frames_of_glob(folder / "*.obj", {}), kBadInput, "are both frame 1");
}

TEST(FramesOfGlob, RefusesAGlobThatFitsNothingOrHasAStarInItsFolder) {
  const test::ScratchFolder folder;
  make(folder, {"a/1.obj", "a/2.txt"});
  EXPECT_ERROR(frames_of_glob(folder / "a/2*", {}), kNotFound, "no mesh file (.obj .ply .off) fits this name");
  EXPECT_ERROR(frames_of_glob(folder / "*/1.obj", {}), kBadInput, "* and ? may stand in the file name only");
}

TEST(FramesOfFolder, AreItsNumberedFiles) {
  const test::ScratchFolder folder;
  make(folder, {"mesh.01.obj", "mesh.02.obj", "mesh.03.obj", "mesh.mtl", "readme.txt", "._mesh.01.obj"});
  EXPECT_THAT(names_of(frames_of_folder(folder.path(), {})), ElementsAre("mesh.01.obj", "mesh.02.obj", "mesh.03.obj"));
}

TEST(FramesOfFolder, AreThoseOfTheOnlyExtensionWithSeveralNumbers) {
  const test::ScratchFolder folder;
  make(folder, {"1.ply", "2.ply", "rest.obj"});
  EXPECT_THAT(names_of(frames_of_folder(folder.path(), {})), ElementsAre("1.ply", "2.ply"));
}

TEST(FramesOfFolder, RefusesSeveralExtensionsWithNumbers) {
  const test::ScratchFolder folder;
  make(folder, {"1.ply", "2.ply", "1.obj", "2.obj", "a.off"});
  EXPECT_ERROR(frames_of_folder(folder.path(), {}), kBadInput, "several kinds (2 .obj, 1 .off, 2 .ply)");
}

TEST(FramesOfFolder, RefusesFilesThatAreNotNumberedInOneWay) {
  const test::ScratchFolder folder;
  make(folder, {"0001.obj", "0002.obj", "rest.obj"});
  EXPECT_ERROR(frames_of_folder(folder.path(), {}), kBadInput,
               "from 0001.obj to rest.obj, are not numbered in one way");
}

TEST(FramesOfFolder, RefusesNumbersThatAreNoFrameNumbers) {
  const test::ScratchFolder folder;
  make(folder, {"20260101120000.obj", "20260101120001.obj"});
  EXPECT_ERROR(frames_of_folder(folder.path(), {}), kBadInput, "not numbered in one way");
  EXPECT_THAT(names_of(frames_of_glob(folder / "*.obj", {})), ElementsAre("20260101120000.obj", "20260101120001.obj"));
}

TEST(FramesOfFolder, RefusesAFolderWithoutMeshes) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(frames_of_folder(folder.path(), {}), kNotFound, "has no mesh files");
}

TEST(FramesOfFile, IsFrameZero) {
  const test::ScratchFolder folder;
  const Result<FrameFiles> files = frames_of_file(folder / "0012.obj", {});
  EXPECT_THAT(names_of(files), ElementsAre("0012.obj"));
  EXPECT_EQ(files->first_number, 0u);
  EXPECT_ERROR(frames_of_file(folder / "0012.obj", {.last = 1}), kNotFound, "there is no frame 1");
}

}  // namespace
}  // namespace limber
