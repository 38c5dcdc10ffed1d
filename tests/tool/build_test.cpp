// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/support/data.h"
#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using tool::Exit;
using Build = ToolTest;

TEST_F(Build, ReportsWhatWasAchievedBesideWhatWasAsked) {
  const Ran ran = run({"build", kSample, "-o", path("a.limber"), "--branching", "8", "--levels", "300,50", "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  EXPECT_EQ(json["schema"], "limber.build/1");
  EXPECT_EQ(json["frames"], 8);
  EXPECT_EQ(json["asked"]["levels"], nlohmann::json({300, 50}));
  EXPECT_EQ(json["levels"], nlohmann::json({600, 300, 50}));
  EXPECT_EQ(json["bytes"], bytes(path("a.limber")).size());
  EXPECT_THAT(names(), ElementsAre("a.limber"));
}

TEST_F(Build, OneThreadAndTwoThreadsGiveTheSameBytes) {
  EXPECT_EQ(bytes(stream("a.limber", {"-j", "1"})), bytes(stream("b.limber", {"-j", "2"})));
}

TEST_F(Build, ADryRunSaysWhatWouldBeDoneAndWritesNothing) {
  const Ran ran = run({"build", kSample, "-o", path("a.limber"), "--dry-run", "--levels", "300,50", "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  EXPECT_EQ(json["frames"], 8);
  EXPECT_EQ(json["vertices"], 600);
  EXPECT_EQ(json["levels"][0], 600);
  EXPECT_EQ(json["levels"][1], 300);
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(Build, ADryRunFindsWhatIsInTheWay) {
  write(path("a.limber"), "mine");
  EXPECT_EQ(run({"build", kSample, "-o", path("a.limber"), "--dry-run"}).exit, Exit::kFailure);
  EXPECT_EQ(run({"build", kSample, "-o", path("a.limber"), "--dry-run", "-f"}).exit, Exit::kDone);
  EXPECT_EQ(bytes(path("a.limber")), "mine");
  write(path("b.obj"), "v 0 0 0\nf 1 2 3\n");
  EXPECT_EQ(run({"build", path("b.obj"), "-o", path("b.limber"), "--dry-run"}).exit, Exit::kBadInput);
}

TEST_F(Build, QuietSaysNothingOnStandardError) {
  const Ran ran = run({"build", kSample, "-o", path("a.limber"), "-q"});
  EXPECT_EQ(ran.exit, Exit::kDone);
  EXPECT_THAT(ran.err, IsEmpty());
}

TEST_F(Build, WithoutATerminalThereIsNoBar) {
  const Ran ran = run({"build", kSample, "-o", path("a.limber")});
  EXPECT_THAT(ran.err, IsEmpty());
  EXPECT_THAT(ran.out, HasSubstr("8 frames, 600 vertices"));
}

TEST_F(Build, TakesSomeFramesAndKeepsTheirNumbers) {
  const std::string part = stream("a.limber", {"--first", "2", "--last", "4"});
  const auto json = run({"info", part, "--json"}).json();
  EXPECT_EQ(json["frames"], 3);
  EXPECT_EQ(json["first_frame"], 2);
}

TEST_F(Build, TakesAStreamAsAClip) {
  const std::string first = stream("a.limber", {"--lossless"});
  ASSERT_EQ(run({"build", first, "-o", path("b.limber"), "--lossless", "-q"}).exit, Exit::kDone);
  EXPECT_EQ(bytes(first), bytes(path("b.limber")));
}

TEST_F(Build, AnOutputThatIsThereIsKeptUnlessForced) {
  write(path("a.limber"), "mine");
  EXPECT_EQ(run({"build", kSample, "-o", path("a.limber")}).exit, Exit::kFailure);
  EXPECT_EQ(bytes(path("a.limber")), "mine");
  EXPECT_EQ(run({"build", kSample, "-o", path("a.limber"), "-f"}).exit, Exit::kDone);
  EXPECT_NE(bytes(path("a.limber")), "mine");
}

TEST_F(Build, AFrameOfAnotherConnectivityIsRefusedAndLeavesNothing) {
  ASSERT_EQ(run({"sample", "flag", "--vertices", "100", "--frames", "3", "-o", path("in/%d.obj")}).exit, Exit::kDone);
  const std::string frame = bytes(path("in/2.obj"));
  write(path("in/2.obj"), frame.substr(0, frame.rfind("f ")));
  const Ran ran = run({"build", path("in"), "-o", path("a.limber"), "--json"});
  EXPECT_EQ(ran.exit, Exit::kBadInput);
  EXPECT_EQ(ran.json()["code"], "mismatch");
  EXPECT_THAT(ran.err, HasSubstr("2.obj"));
  EXPECT_THAT(names(), ElementsAre("in"));
}

TEST_F(Build, AFrameThatBreaksOffLeavesTheOldOutputAsItWas) {
  ASSERT_EQ(run({"sample", "flag", "--vertices", "100", "--frames", "3", "-o", path("in/%d.ply")}).exit, Exit::kDone);
  const std::string frame = bytes(path("in/2.ply"));
  write(path("in/2.ply"), frame.substr(0, frame.size() / 2));
  write(path("a.limber"), "mine");
  EXPECT_EQ(run({"build", path("in"), "-o", path("a.limber"), "-f"}).exit, Exit::kBadInput);
  EXPECT_EQ(bytes(path("a.limber")), "mine");
  EXPECT_THAT(names(), testing::UnorderedElementsAre("in", "a.limber"));
}

TEST_F(Build, RefusesArgumentsThatMakeNoSense) {
  const auto exit_of = [this](std::vector<std::string> options) {
    options.insert(options.begin(), {"build", kSample, "-o", path("a.limber")});
    return run(options).exit;
  };
  EXPECT_EQ(exit_of({"--levels", "50,300"}), Exit::kUsage);
  EXPECT_EQ(exit_of({"--levels", "50,50"}), Exit::kUsage);
  EXPECT_EQ(exit_of({"--levels", "0"}), Exit::kUsage);
  EXPECT_EQ(exit_of({"--lossless", "--tolerance", "0.1"}), Exit::kUsage);
  EXPECT_EQ(exit_of({"--tolerance", "0"}), Exit::kUsage);
  EXPECT_EQ(exit_of({"--keys", "0"}), Exit::kUsage);
  EXPECT_EQ(exit_of({"--topology", "any"}), Exit::kUsage);
  EXPECT_EQ(run({"build", kSample, "-o", path("a.obj")}).exit, Exit::kUsage);
  EXPECT_EQ(run({"build", kSample, "-o", "-", "--json"}).exit, Exit::kUsage);
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(Build, EveryOptionGivesASoundStream) {
  const std::vector<std::vector<std::string>> all = {
      {"--topology", "free"},  {"--branching", "2"}, {"--base-frames", "1"},    {"--threshold", "0"},
      {"--fit", "0"},          {"--keys", "1"},      {"--coarser-weight", "1"}, {"--growth", "1.9127"},
      {"--tolerance", "0.01"}, {"--follow", "calm"}, {"--follow", "close"},     {"--follow", "paper"},
      {"--hysteresis", "0"},   {"--restart", "0"},   {"--max-changed", "0.02"}};
  for (const auto& options : all) {
    const std::string made = stream("a.limber", [&] {
      auto with_force = options;
      with_force.push_back("-f");
      return with_force;
    }());
    const Ran checked = run({"check", made, "--all", "--against", kSample});
    EXPECT_EQ(checked.exit, Exit::kDone) << options[0] << ": " << checked.out << checked.err;
  }
}

TEST_F(Build, TheNumbersBehindFollowMayBeGivenByThemselvesBeforeItOrAfterIt) {
  const auto made = [this](std::vector<std::string> options) {
    options.push_back("-f");
    return bytes(stream("a.limber", options));
  };
  const std::string calm = made({"--follow", "calm"});
  EXPECT_NE(calm, made({}));
  EXPECT_EQ(calm, made({"--threshold", "0.2", "--hysteresis", "3", "--restart", "0.7"}));
  EXPECT_EQ(made({}), made({"--follow", "balanced"}));
  EXPECT_EQ(made({}), made({"--threshold", "0.05", "--follow", "calm", "--hysteresis", "1.5"}));
}

TEST_F(Build, RefusesAClipThatIsMeshedAnewInEveryFrame) {
  LIMBER_DATA_SET(folder, "remeshed-camel");
  const Ran ran = run({"build", folder.string(), "-o", path("a.limber")});
  EXPECT_EQ(ran.exit, Exit::kBadInput);
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(Build, TheHorseGallopsThrough) {
  LIMBER_DATA_SET(folder, "horse-gallop");
  ASSERT_EQ(run({"build", (folder / "%04d.obj").string(), "--last", "3", "-o", path("a.limber"), "-q"}).exit,
            Exit::kDone);
  const Ran checked =
      run({"check", path("a.limber"), "--all", "--against", (folder / "*.obj").string(), "--last", "3"});
  EXPECT_EQ(checked.exit, Exit::kDone) << checked.out << checked.err;
}

}  // namespace
}  // namespace limber::test
