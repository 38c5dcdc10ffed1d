// SPDX-License-Identifier: Apache-2.0
#include "tool/program.h"

#include <gmock/gmock.h>

#include "tests/tool/run.h"
#include "tool/verb.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using tool::Exit;

// One line of the form "limber: WHERE: WHAT".
void expect_error_line(const Ran& ran) {
  EXPECT_THAT(ran.err, StartsWith("limber: "));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_THAT(ran.out, IsEmpty());
}

TEST(Program, HelpListsEveryVerb) {
  const Ran ran = run({"--help"});
  EXPECT_EQ(ran.exit, Exit::kDone);
  EXPECT_THAT(ran.err, IsEmpty());
  for (const tool::Verb& verb : tool::verbs()) EXPECT_THAT(ran.out, HasSubstr("  " + std::string(verb.name) + " "));
}

TEST(Program, EveryVerbHasHelpWithAnExampleAndTheConventions) {
  for (const tool::Verb& verb : tool::verbs()) {
    const std::string name(verb.name);
    const Ran ran = run({name, "--help"});
    EXPECT_EQ(ran.exit, Exit::kDone);
    EXPECT_THAT(ran.out, HasSubstr("Examples:\n  limber " + name));
    for (const char* option : {"--json", "--quiet", "--threads"}) EXPECT_THAT(ran.out, HasSubstr(option)) << name;
    EXPECT_EQ(run({"help", name}).out, ran.out);
  }
}

TEST(Program, VersionNamesTheFormatsReadAndWritten) {
  const Ran ran = run({"--version"});
  EXPECT_EQ(ran.exit, Exit::kDone);
  EXPECT_THAT(ran.out, StartsWith("limber "));
  EXPECT_THAT(ran.out, HasSubstr("Reads: "));
  EXPECT_THAT(ran.out, HasSubstr("Writes: "));
}

TEST(Program, NoVerbIsAUsageError) {
  const Ran ran = run({});
  EXPECT_EQ(ran.exit, Exit::kUsage);
  expect_error_line(ran);
}

TEST(Program, AMisspeltVerbIsAnsweredWithTheOneMeant) {
  const Ran ran = run({"biuld", "x"});
  EXPECT_EQ(ran.exit, Exit::kUsage);
  expect_error_line(ran);
  EXPECT_THAT(ran.err, HasSubstr("did you mean build?"));
}

TEST(Program, AMisspeltOptionIsAnsweredWithTheOneMeant) {
  const Ran ran = run({"build", "x", "-o", "y.limber", "--branchnig", "4"});
  EXPECT_EQ(ran.exit, Exit::kUsage);
  expect_error_line(ran);
  EXPECT_THAT(ran.err, HasSubstr("did you mean --branching?"));
}

TEST(Program, AVerbWithoutItsInputIsAUsageError) {
  const Ran ran = run({"info"});
  EXPECT_EQ(ran.exit, Exit::kUsage);
  expect_error_line(ran);
  EXPECT_THAT(ran.err, HasSubstr("info: FILE is required"));
}

TEST(Program, AUsageErrorIsJsonToo) {
  const Ran ran = run({"info", "--json"});
  EXPECT_EQ(ran.exit, Exit::kUsage);
  EXPECT_EQ(ran.json()["schema"], "limber.error/1");
  EXPECT_EQ(ran.json()["code"], "usage");
  EXPECT_EQ(ran.json()["exit"], 2);
  EXPECT_EQ(run({"inof", "--json"}).json()["schema"], "limber.error/1");
}

TEST(Program, AMissingInputIsBadInput) {
  const Ran ran = run({"info", "nowhere.limber"});
  EXPECT_EQ(ran.exit, Exit::kBadInput);
  expect_error_line(ran);
  EXPECT_EQ(ran.err, "limber: nowhere.limber: no such file\n");
}

TEST(Program, AnErrorIsJsonToo) {
  const Ran ran = run({"info", "nowhere.limber", "--json"});
  EXPECT_EQ(ran.exit, Exit::kBadInput);
  const auto json = ran.json();
  EXPECT_EQ(json["schema"], "limber.error/1");
  EXPECT_EQ(json["code"], "not-found");
  EXPECT_EQ(json["exit"], 3);
  EXPECT_EQ(json["where"], "nowhere.limber");
  EXPECT_EQ(json["what"], "no such file");
}

TEST(Program, NumbersOutOfRangeAreUsageErrors) {
  for (const char* value : {"0", "1", "nan", "-3", "many"})
    EXPECT_EQ(run({"build", "x", "-o", "y.limber", "--branching", value}).exit, Exit::kUsage) << value;
  for (const char* value : {"-1", "1.5", "4294967296"})
    EXPECT_EQ(run({"build", "x", "-o", "y.limber", "--first", value}).exit, Exit::kUsage) << value;
  EXPECT_EQ(run({"info", "x", "-j", "-1"}).exit, Exit::kUsage);
}

TEST(Program, ANameWithALineEndCannotBreakTheErrorLine) {
  const Ran ran = run({"info", "no\nwhere"});
  expect_error_line(ran);
  EXPECT_THAT(ran.err, HasSubstr("no\\x0awhere"));
}

TEST(Program, ANameThatIsNotUtf8StillGivesJson) {
  const Ran ran = run({"info", "\xff\xfe", "--json"});
  EXPECT_EQ(ran.json()["code"], "not-found");
}

using ProgramFiles = ToolTest;

TEST_F(ProgramFiles, AGlobThatTheShellHasExpandedIsAnsweredWithQuotes) {
  ASSERT_EQ(run({"sample", "flag", "--vertices", "100", "--frames", "3", "-o", path("%d.obj")}).exit, Exit::kDone);
  const Ran ran = run({"convert", path("0.obj"), path("1.obj"), path("2.obj"), "-o", path("a.pc2")});
  EXPECT_EQ(ran.exit, Exit::kUsage);
  EXPECT_THAT(ran.err, HasSubstr("quotes"));
}

TEST_F(ProgramFiles, PatternsGlobsAndFoldersAreTheSameClip) {
  ASSERT_EQ(run({"sample", "flag", "--vertices", "100", "--frames", "11", "-o", path("in/%d.obj")}).exit, Exit::kDone);
  ASSERT_EQ(run({"convert", path("in/%d.obj"), "-o", path("a.pc2")}).exit, Exit::kDone);
  ASSERT_EQ(run({"convert", path("in/*.obj"), "-o", path("b.pc2")}).exit, Exit::kDone);
  ASSERT_EQ(run({"convert", path("in"), "-o", path("c.pc2")}).exit, Exit::kDone);
  EXPECT_EQ(bytes(path("a.pc2")), bytes(path("b.pc2")));
  EXPECT_EQ(bytes(path("a.pc2")), bytes(path("c.pc2")));
}

TEST_F(ProgramFiles, FramesAreChosenByTheNumbersOfTheSource) {
  const Ran ran = run({"convert", kSample, "--first", "3", "--last", "5", "-o", path("%02d.obj"), "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["schema"], "limber.convert/1");
  EXPECT_EQ(ran.json()["frames"], 3);
  EXPECT_THAT(names(), testing::UnorderedElementsAre("03.obj", "04.obj", "05.obj"));
  ASSERT_EQ(run({"convert", kSample, "-o", path("all/%02d.obj")}).exit, Exit::kDone);
  EXPECT_EQ(bytes(path("04.obj")), bytes(path("all/04.obj")));
  EXPECT_EQ(run({"convert", kSample, "--first", "8", "-o", path("x.pc2")}).exit, Exit::kBadInput);
}

TEST_F(ProgramFiles, ARangeOfFramesMayHaveAStep) {
  const std::vector<std::pair<std::string, int>> ranges{{"4", 1}, {"2-", 6}, {"-2", 3}, {"1-5x2", 3}, {"x3", 3}};
  for (const auto& [range, count] : ranges) {
    const Ran ran = run({"convert", kSample, "--frames", range, "-f", "-o", path("a.pc2"), "--json"});
    ASSERT_EQ(ran.exit, Exit::kDone) << range << ran.err;
    EXPECT_EQ(ran.json()["frames"], count) << range;
  }
  ASSERT_EQ(run({"convert", kSample, "--frames", "1-5x2", "-o", path("a/%02d.obj")}).exit, Exit::kDone);
  ASSERT_EQ(run({"convert", kSample, "-o", path("b/%02d.obj")}).exit, Exit::kDone);
  EXPECT_EQ(bytes(path("a/03.obj")), bytes(path("b/05.obj")));
  for (const char* const wrong : {"", "a", "1-2-3", "1x", "1-5x0", "5-1"})
    EXPECT_NE(run({"convert", kSample, "--frames", wrong, "-f", "-o", path("a.pc2")}).exit, Exit::kDone) << wrong;
  EXPECT_EQ(run({"convert", kSample, "--frames", "1", "--last", "2", "-f", "-o", path("a.pc2")}).exit, Exit::kUsage);
}

TEST_F(ProgramFiles, SamplesAreListed) {
  const auto json = run({"sample", "--json"}).json();
  EXPECT_EQ(json["schema"], "limber.samples/1");
  EXPECT_EQ(json["samples"].size(), 4u);
  EXPECT_EQ(run({"sample", "galop", "-o", path("x.pc2")}).exit, Exit::kUsage);
}

TEST_F(ProgramFiles, AnExistingOutputIsKeptUnlessForced) {
  write(path("a.pc2"), "mine");
  const Ran ran = run({"convert", kSample, "-o", path("a.pc2")});
  EXPECT_EQ(ran.exit, Exit::kFailure);
  EXPECT_THAT(ran.err, HasSubstr("-f"));
  EXPECT_EQ(bytes(path("a.pc2")), "mine");
  EXPECT_EQ(run({"convert", kSample, "-o", path("a.pc2"), "-f"}).exit, Exit::kDone);
  EXPECT_NE(bytes(path("a.pc2")), "mine");
}

}  // namespace
}  // namespace limber::test
