// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using tool::Exit;
using MeasureVerb = ToolTest;

constexpr const char* kTwo = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
constexpr const char* kRaised = "v 0 0 .1\nv 1 0 .1\nv 0 1 .1\nv 1 1 .1\nf 1 2 4\nf 1 4 3\n";

TEST_F(MeasureVerb, GivesTheDistanceOfTwoMeshes) {
  write(path("a.obj"), kTwo);
  write(path("b.obj"), kRaised);
  const Ran ran = run({"measure", path("a.obj"), path("b.obj"), "--samples", "1000", "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  EXPECT_EQ(json["schema"], "limber.measure/1");
  EXPECT_NEAR(json["rms"].get<double>(), 10 / std::sqrt(2), 1e-4);
  EXPECT_EQ(json["frames"][0]["to_original"]["samples"], 1000);
  EXPECT_TRUE(json["flicker"].is_null());
  EXPECT_EQ(json["sampling"]["original_samples"], 1000);
  const std::string table = run({"measure", path("a.obj"), path("b.obj"), "--sampling", "metro", "--seed", "5"}).out;
  EXPECT_THAT(table, HasSubstr("7.071"));
  EXPECT_THAT(table, HasSubstr("as Metro takes them, seed 5; rms to within 0.00000 with 95 % confidence"));
}

TEST_F(MeasureVerb, TheApproximationMayChangeItsConnectivity) {
  for (const char* const frame : {"1.obj", "2.obj"}) write(path(std::string("o") + frame), kTwo);
  write(path("a1.obj"), kTwo);
  write(path("a2.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Ran ran = run({"measure", path("o%d.obj"), path("a%d.obj"), "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["frames"][1]["frame"], 2);
  EXPECT_EQ(ran.json()["frames"][1]["triangles"], 1);
  EXPECT_EQ(run({"measure", path("a%d.obj"), path("o%d.obj")}).exit, Exit::kBadInput);
}

TEST_F(MeasureVerb, DifferentNumbersOfFramesAreRefused) {
  write(path("a.obj"), kTwo);
  const Ran ran = run({"measure", "sample:flag?vertices=100&frames=2", path("a.obj")});
  EXPECT_EQ(ran.exit, Exit::kBadInput);
  EXPECT_THAT(ran.err, HasSubstr("has 1 frame,"));
}

TEST_F(MeasureVerb, TakesALevelOfAStream) {
  const std::string file = stream();
  const Ran ran = run({"measure", kSample, file, "--vertices", "80", "--samples", "2000", "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["frames"].size(), 8u);
  EXPECT_FALSE(ran.json()["changed"].is_null());
  const double coarse = ran.json()["rms"];
  const double finest = run({"measure", kSample, file, "--samples", "2000", "--json"}).json()["rms"];
  EXPECT_LT(finest, 0.01);
  EXPECT_GT(coarse, 0.1);
  EXPECT_EQ(run({"measure", file, kSample, "--samples", "1000", "-q"}).exit, Exit::kDone);
}

TEST_F(MeasureVerb, OnlyStreamsHaveLevels) {
  EXPECT_EQ(run({"measure", kSample, kSample, "--vertices", "80"}).exit, Exit::kUsage);
  EXPECT_EQ(run({"measure", kSample, stream(), "--vertices", "80", "--level", "1"}).exit, Exit::kUsage);
}

}  // namespace
}  // namespace limber::test
