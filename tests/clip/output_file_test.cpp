// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/output_file.h"

#include <array>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(OutputFile, HasItsNameOnlyAfterCommit) {
  const test::ScratchFolder folder;
  Result<OutputFile> file = OutputFile::create(folder / "a.txt", false);
  ASSERT_DONE(file);
  ASSERT_DONE(file->write(std::string("hello ")));
  ASSERT_DONE(file->write(std::string("world")));
  EXPECT_EQ(file->size(), 11u);
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
  ASSERT_DONE(file->commit());
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
  EXPECT_EQ(folder.read("a.txt"), "hello world");
}

TEST(OutputFile, LeavesNothingBehindWhenItIsNotCommitted) {
  const test::ScratchFolder folder;
  {
    Result<OutputFile> file = OutputFile::create(folder / "a.txt", false);
    ASSERT_DONE(file);
    ASSERT_DONE(file->write(std::string("hello")));
    EXPECT_EQ(folder.names().size(), 1u);
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(OutputFile, LeavesNothingBehindWhenItIsClosedButNotCommitted) {
  const test::ScratchFolder folder;
  {
    Result<OutputFile> file = OutputFile::create(folder / "a.txt", false);
    ASSERT_DONE(file);
    ASSERT_DONE(file->close());
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(OutputFile, RefusesAnExistingFile) {
  const test::ScratchFolder folder;
  folder.write("a.txt", "old");
  EXPECT_ERROR(OutputFile::create(folder / "a.txt", false), kExists, "a.txt: is already there; use -f to replace it");
  EXPECT_EQ(folder.read("a.txt"), "old");
}

TEST(OutputFile, RefusesAFileThatAppearedMeanwhile) {
  const test::ScratchFolder folder;
  {
    Result<OutputFile> file = OutputFile::create(folder / "a.txt", false);
    ASSERT_DONE(file);
    folder.write("a.txt", "other");
    EXPECT_ERROR(file->commit(), kExists, "a.txt");
  }
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
  EXPECT_EQ(folder.read("a.txt"), "other");
}

TEST(OutputFile, ReplacesAnExistingFileOnRequestAndOnlyWhenItIsWhole) {
  const test::ScratchFolder folder;
  folder.write("a.txt", "old");
  fs::permissions(folder / "a.txt", fs::perms::owner_read | fs::perms::owner_write);
  {
    Result<OutputFile> file = OutputFile::create(folder / "a.txt", true);
    ASSERT_DONE(file);
    ASSERT_DONE(file->write(std::string("new")));
    EXPECT_EQ(folder.read("a.txt"), "old");
    ASSERT_DONE(file->commit());
  }
  EXPECT_EQ(folder.read("a.txt"), "new");
  EXPECT_EQ(fs::status(folder / "a.txt").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  {
    Result<OutputFile> file = OutputFile::create(folder / "a.txt", true);
    ASSERT_DONE(file);
    ASSERT_DONE(file->write(std::string("newer")));
  }
  EXPECT_EQ(folder.read("a.txt"), "new");
}

TEST(OutputFile, ReplacesTheTargetOfASymbolicLink) {
  const test::ScratchFolder folder;
  folder.write("target/a.txt", "old");
  fs::create_symlink(folder / "target/a.txt", folder / "link.txt");
  Result<OutputFile> file = OutputFile::create(folder / "link.txt", true);
  ASSERT_DONE(file);
  ASSERT_DONE(file->write(std::string("new")));
  ASSERT_DONE(file->commit());
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(folder.read("target/a.txt"), "new");
}

TEST(OutputFile, WritesToADeviceWithoutReplacingIt) {
  Result<OutputFile> file = OutputFile::create("/dev/null", false);
  ASSERT_DONE(file);
  ASSERT_DONE(file->write(std::string("gone")));
  ASSERT_DONE(file->commit());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(OutputFile, SaysThatADeviceIsFull) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  Result<OutputFile> file = OutputFile::create("/dev/full", false);
  ASSERT_DONE(file);
  ASSERT_DONE(file->write(std::string("x")));
  EXPECT_ERROR(file->commit(), kIo, "/dev/full: cannot be written: No space left on device");
}

TEST(OutputFile, RefusesFoldersAndMissingFolders) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(OutputFile::create(folder.path(), true), kExists, "is a folder");
  EXPECT_ERROR(OutputFile::create(folder / "none/a.txt", true), kNotFound, "there is no folder");
}

TEST(OutputFile, ReplacesAndReadsBackBytesThatAreWritten) {
  const test::ScratchFolder folder;
  Result<OutputFile> file = OutputFile::create(folder / "a.txt", false);
  ASSERT_DONE(file);
  ASSERT_DONE(file->write(std::string("0000-body")));
  ASSERT_DONE(file->write_at(0, std::string("head")));
  std::array<char, 4> piece;
  ASSERT_DONE(file->read_at(5, piece));
  EXPECT_EQ(std::string_view(piece.data(), 4), "body");
  ASSERT_DONE(file->write(std::string("-tail")));
  ASSERT_DONE(file->commit());
  EXPECT_EQ(folder.read("a.txt"), "head-body-tail");
}

TEST(OutputFile, CanBeMoved) {
  const test::ScratchFolder folder;
  Result<OutputFile> a = OutputFile::create(folder / "a.txt", false);
  Result<OutputFile> b = OutputFile::create(folder / "b.txt", false);
  ASSERT_TRUE(a && b);
  *a = std::move(*b);
  EXPECT_EQ(folder.names().size(), 1u);
  OutputFile moved(std::move(*a));
  ASSERT_DONE(moved.commit());
  EXPECT_THAT(folder.names(), ElementsAre("b.txt"));
}

}  // namespace
}  // namespace limber
