// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using tool::Exit;
using Info = ToolTest;

TEST_F(Info, SaysWhatIsInAStream) {
  const std::string file = stream("a.limber", {"--keys", "3"});
  const Ran ran = run({"info", file, "--frames", "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  EXPECT_EQ(json["schema"], "limber.info/1");
  EXPECT_EQ(json["complete"], true);
  EXPECT_EQ(json["frames"], 8);
  EXPECT_EQ(json["keys"], 3);
  EXPECT_EQ(json["levels"], nlohmann::json({600, 300, 150, 75, 38, 19}));
  EXPECT_EQ(json["bytes"], bytes(file).size());
  ASSERT_EQ(json["frame_table"].size(), 8u);
  std::size_t sum = 0;
  for (const auto& row : json["frame_table"]) sum += row["bytes"].get<std::size_t>();
  EXPECT_NEAR(json["bytes_per_frame"]["total"].get<double>() * 8, static_cast<double>(sum), 1e-6);
}

TEST_F(Info, SwapsAreThoseThatBuildReports) {
  const auto built = run({"build", kSample, "-o", path("a.limber"), "--keys", "2", "--json"}).json();
  const auto told = run({"info", path("a.limber"), "--json"}).json();
  EXPECT_EQ(told["swaps"], built["swaps"]);
  EXPECT_EQ(told["bytes_per_frame"], built["bytes_per_frame"]);
}

TEST_F(Info, DegenerateSetsChangeWhereSwapsAre) {
  const auto json = run({"info", stream(), "--frames", "--json"}).json();
  double sum = 0;
  for (const auto& row : json["frame_table"]) {
    const double changes = row["degenerate_changes"];
    if (row["swaps"] == 0) {
      EXPECT_EQ(changes, 0);
    }
    sum += changes;
  }
  EXPECT_GT(sum, 0);
  EXPECT_NEAR(json["degenerate_changes"]["mean"].get<double>() * 7, sum, 1e-6);
}

TEST_F(Info, AStreamThatEndsEarlyIsShownWithAWarning) {
  const std::string whole = bytes(stream());
  write(path("b.limber"), whole.substr(0, whole.size() * 2 / 3));
  const Ran ran = run({"info", path("b.limber"), "--json"});
  EXPECT_EQ(ran.exit, Exit::kDone);
  EXPECT_EQ(ran.json()["complete"], false);
  EXPECT_THAT(ran.err, HasSubstr("ends early"));
}

}  // namespace
}  // namespace limber::test
