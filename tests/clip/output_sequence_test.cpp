// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/output_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "tests/clip/sample_meshes.h"
#include "tests/clip/scratch_folder.h"

namespace limber {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Writes `count` files that hold their place in the order.
Result<void> write_files(OutputSequence& sequence, int count) {
  for (int i = 0; i < count; ++i) {
    Result<OutputFile*> file = sequence.next();
    if (!file) return file.error();
    if (Result<void> done = (*file)->write(std::to_string(i)); !done) return done;
  }
  return {};
}

TEST(OutputSequence, GivesAllFilesTheirNamesAtTheEnd) {
  const test::ScratchFolder folder;
  Result<OutputSequence> sequence = OutputSequence::create(folder / "%03d.txt", 9, false);
  ASSERT_DONE(sequence);
  ASSERT_DONE(write_files(*sequence, 3));
  EXPECT_FALSE(std::filesystem::exists(folder / "009.txt"));
  ASSERT_DONE(sequence->finish());
  EXPECT_THAT(folder.names(), ElementsAre("009.txt", "010.txt", "011.txt"));
  EXPECT_EQ(folder.read("011.txt"), "2");
}

TEST(OutputSequence, MakesTheFolderAndRemovesItAgainWhenItIsNotFinished) {
  const test::ScratchFolder folder;
  {
    Result<OutputSequence> sequence = OutputSequence::create(folder / "a/b/%d.txt", 0, false);
    ASSERT_DONE(sequence);
    ASSERT_DONE(write_files(*sequence, 2));
    EXPECT_EQ(folder.names().size(), 4u);
  }
  EXPECT_THAT(folder.names(), IsEmpty());
  Result<OutputSequence> sequence = OutputSequence::create(folder / "a/b/%d.txt", 0, false);
  ASSERT_DONE(sequence);
  ASSERT_DONE(write_files(*sequence, 1));
  ASSERT_DONE(sequence->finish());
  EXPECT_THAT(folder.names(), ElementsAre("a", "a/b", "a/b/0.txt"));
}

TEST(OutputSequence, RefusesAnyFileThatFitsThePattern) {
  const test::ScratchFolder folder;
  folder.write("70.txt", "old");
  EXPECT_ERROR(OutputSequence::create(folder / "%d.txt", 0, false), kExists, "70.txt: is already there; use -f");
  EXPECT_TRUE(OutputSequence::create(folder / "%03d.txt", 0, false));
}

TEST(OutputSequence, ReplacesFilesOnRequest) {
  const test::ScratchFolder folder;
  folder.write("1.txt", "old");
  folder.write("70.txt", "old");
  Result<OutputSequence> sequence = OutputSequence::create(folder / "%d.txt", 1, true);
  ASSERT_DONE(sequence);
  ASSERT_DONE(write_files(*sequence, 2));
  ASSERT_DONE(sequence->finish());
  EXPECT_THAT(folder.names(), ElementsAre("1.txt", "2.txt", "70.txt"));
  EXPECT_EQ(folder.read("1.txt"), "0");
}

TEST(OutputSequence, LeavesNothingWhenALaterFileCannotHaveItsName) {
  const test::ScratchFolder folder;
  {
    Result<OutputSequence> sequence = OutputSequence::create(folder / "%d.txt", 0, false);
    ASSERT_DONE(sequence);
    ASSERT_DONE(write_files(*sequence, 3));
    folder.write("2.txt", "other");
    EXPECT_ERROR(sequence->finish(), kExists, "2.txt");
  }
  EXPECT_THAT(folder.names(), ElementsAre("2.txt"));
  EXPECT_EQ(folder.read("2.txt"), "other");
}

TEST(OutputSequence, HoldsOneFileWhereTheNameHasNoNumber) {
  const test::ScratchFolder folder;
  Result<OutputSequence> sequence = OutputSequence::create(folder / "a.txt", 7, false);
  ASSERT_DONE(sequence);
  ASSERT_DONE(write_files(*sequence, 1));
  EXPECT_ERROR(sequence->next(), kBadInput, "a file holds one frame");
  ASSERT_DONE(sequence->finish());
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(OutputSequence, RefusesToFinishWithoutFiles) {
  const test::ScratchFolder folder;
  Result<OutputSequence> sequence = OutputSequence::create(folder / "%d.txt", 7, false);
  ASSERT_DONE(sequence);
  EXPECT_ERROR(sequence->finish(), kBadInput, "7.txt: there are no frames to write");
}

TEST(OutputSequence, HoldsMoreFilesThanMayBeOpenAtOnce) {
  const test::ScratchFolder folder;
  Result<OutputSequence> sequence = OutputSequence::create(folder / "%d.txt", 0, false);
  ASSERT_DONE(sequence);
  ASSERT_DONE(write_files(*sequence, 1500));
  ASSERT_DONE(sequence->finish());
  EXPECT_EQ(folder.names().size(), 1500u);
}

TEST(OutputSequence, RefusesABrokenPattern) {
  const test::ScratchFolder folder;
  EXPECT_ERROR(OutputSequence::create(folder / "%s.txt", 0, false), kBadInput, "a pattern needs one frame number");
}

}  // namespace
}  // namespace limber
