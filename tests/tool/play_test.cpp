// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/support/markup.h"
#include "tests/tool/run.h"

namespace limber::test {
namespace {

using tool::Exit;
using Play = ToolTest;

TEST_F(Play, ReportsTheTimesOfEveryStep) {
  const Ran ran = run({"play", stream(), "--vertices", "100", "--repeat", "2", "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  EXPECT_EQ(json["schema"], "limber.play/1");
  EXPECT_LE(json["cut_vertices"], 100);
  EXPECT_GT(json["cut_triangles"], 100);
  for (const char* step : {"update", "hierarchy", "cut", "triangles", "positions", "copy"}) {
    EXPECT_GE(json["milliseconds"][step]["median"], 0.0) << step;
    EXPECT_GE(json["milliseconds"][step]["p95"], json["milliseconds"][step]["median"]) << step;
  }
}

TEST_F(Play, ReportsTheTimeOfABlendWhereThereIsOne) {
  const std::string file = stream();
  const auto json = run({"play", file, "--vertices", "100", "--blend", "3", "--json"}).json();
  EXPECT_EQ(json["blend"], 3);
  EXPECT_GT(json["milliseconds"]["blend"]["median"], 0.0);
  EXPECT_FALSE(run({"play", file, "--vertices", "100", "--json"}).json()["milliseconds"].contains("blend"));
}

TEST_F(Play, DrawsTheUpdateOfEveryFrame) {
  const std::string file = stream();
  const Ran ran = run({"play", file, "--json", "-o", path("update.svg")});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["frame_update_milliseconds"].size() + 1, ran.json()["frames"].get<std::size_t>());
  const std::string chart = bytes(path("update.svg"));
  EXPECT_EQ(markup_fault(chart), "");
  EXPECT_THAT(chart, testing::HasSubstr(">hierarchy</text>"));
  EXPECT_EQ(run({"play", file, "-o", path("update.svg")}).exit, Exit::kFailure);
  EXPECT_EQ(run({"play", file, "-o", path("update.png")}).exit, Exit::kUsage);
}

TEST_F(Play, TurnsTheEyeAroundItsTarget) {
  const std::string file = stream();
  const std::vector<std::string> look = {"--eye", "0,0.5,4", "--target", "0,0,0", "--pixels", "3", "--json"};
  std::vector<std::string> command = {"play", file, "--turn", "2"};
  command.insert(command.end(), look.begin(), look.end());
  const Ran ran = run(command);
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["asked"]["pixels"], 3);
  EXPECT_EQ(ran.json()["turn"], 2);
  EXPECT_GT(ran.json()["milliseconds"]["moving"]["median"], 0.0);
  EXPECT_GT(ran.json()["cut_vertices"], 10);
  EXPECT_EQ(run({"play", file, "--turn", "2"}).exit, Exit::kUsage);
  EXPECT_EQ(run({"play", file, "--pixels", "2"}).exit, Exit::kUsage);
}

TEST_F(Play, AStreamOfOneFrameHasNoSteps) {
  const Ran ran = run({"play", stream("a.limber", {"--last", "0"}), "--json"});
  EXPECT_EQ(ran.exit, Exit::kDone) << ran.err;
}

}  // namespace
}  // namespace limber::test
