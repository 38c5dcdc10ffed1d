// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/input_file.h"

#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

TEST(InputFile, ReadsPiecesAtAnyOffset) {
  const test::ScratchFolder folder;
  Result<InputFile> file = InputFile::open(folder.write("a", "0123456789"));
  ASSERT_DONE(file);
  EXPECT_EQ(file->size(), 10u);
  std::array<char, 3> piece;
  ASSERT_DONE(file->read(7, piece));
  EXPECT_EQ(std::string_view(piece.data(), 3), "789");
  EXPECT_ERROR(file->read(8, piece), kTruncated, "a, byte 10: the file ends here");
  ASSERT_DONE(file->read(0, piece));
  EXPECT_EQ(std::string_view(piece.data(), 3), "012");
}

TEST(InputFile, RefusesMissingFilesFoldersAndDevices) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(InputFile::open(folder / "none"), kNotFound, "none: no such file");
  EXPECT_ERROR(InputFile::open(folder.path()), kIo, "is not a file");
  EXPECT_ERROR(InputFile::open("/dev/zero"), kIo, "is not a file");
}

TEST(InputFile, NamesTheReasonWhyAFileCannotBeOpened) {
  const test::ScratchFolder folder;
  const std::string path = folder.write("a", "x");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  if (std::ifstream(path)) GTEST_SKIP() << "this user may read everything";
  EXPECT_ERROR(InputFile::open(path), kIo, "cannot be opened: Permission denied");
}

TEST(InputFile, GivesExtensionsInLowerCase) {
  EXPECT_EQ(lower_case_extension("a/b.c/D.ObJ"), ".obj");
  EXPECT_EQ(lower_case_extension("a.b/c"), "");
}

}  // namespace
}  // namespace limber
