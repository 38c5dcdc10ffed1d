// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

#include "eval/methods/method.h"
#include "tests/support/markup.h"
#include "tests/tool/fin.h"
#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;
using tool::Exit;
using CompareVerb = ToolTest;

std::vector<std::string> two_methods(const std::string& output) {
  return {"compare",    "sample:gallop?vertices=600&frames=3",
          "--method",   "first-frame,direct",
          "--vertices", "80",
          "--samples",  "2000",
          "-o",         output};
}

std::vector<std::string> in_folder(const std::string& folder) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) found.push_back(entry.path().filename());
  return found;
}

TEST_F(CompareVerb, WritesAPageThatHasEverything) {
  const Ran ran = run(two_methods(path("a/b/")));
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_THAT(in_folder(path("a/b")), UnorderedElementsAre("index.html", "report.json", "frames.csv"));
  const std::string page = bytes(path("a/b/index.html"));
  EXPECT_EQ(markup_fault(page), "");
  for (const char* const section :
       {"summary", "rms", "trade-off", "time", "storage", "histograms", "gallery", "close-ups", "made"})
    EXPECT_THAT(page, HasSubstr(std::string("<section id=\"") + section + "\">"));
  EXPECT_THAT(page, HasSubstr("limber compare &#39;sample:gallop?vertices=600&amp;frames=3&#39;"));
  EXPECT_THAT(page, Not(HasSubstr("http")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_LT(page.size(), 10'000'000u);
}

TEST_F(CompareVerb, ItsNumbersAreThoseOfSimplify) {
  std::vector<std::string> arguments = two_methods(path("report"));
  arguments.push_back("--json");
  const Ran ran = run(arguments);
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = nlohmann::json::parse(bytes(path("report/report.json")));
  EXPECT_EQ(json["schema"], "limber.compare/1");
  EXPECT_EQ(ran.json()["methods"], json["methods"]);
  const auto other = run({"simplify", "sample:gallop?vertices=600&frames=3", "--method", "direct,first-frame",
                          "--vertices", "80", "--samples", "2000", "--measure", "--json"})
                         .json();
  ASSERT_EQ(json["methods"].size(), 2u);
  for (std::size_t m = 0; m < 2; ++m) {
    const auto &mine = json["methods"][m], &theirs = other["methods"][m];
    for (const char* const key : {"method", "rms", "mean", "max", "flicker", "changed", "quadric_error", "vertices"})
      EXPECT_EQ(mine[key], theirs[key]) << key;
    ASSERT_EQ(mine["frames"].size(), 3u);
    EXPECT_EQ(mine["frames"][2]["rms"], theirs["frames"][2]["rms"]);
  }
}

TEST_F(CompareVerb, TheTableHasALinePerMethodAndFrame) {
  ASSERT_EQ(run(two_methods(path("report"))).exit, Exit::kDone);
  const std::string csv = bytes(path("report/frames.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 3);
  EXPECT_THAT(csv, HasSubstr("\n0,direct,80,"));
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = csv.find('\n', begin)) != std::string::npos; begin = end + 1)
    EXPECT_EQ(std::count(csv.begin() + static_cast<long>(begin), csv.begin() + static_cast<long>(end), ','), 17);
}

TEST_F(CompareVerb, TakesEveryMethodWhereNoneIsNamed) {
  const Ran ran = run({"compare", "sample:gallop?vertices=300&frames=2", "--vertices", "60", "--samples", "500", "-o",
                       path("report"), "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_EQ(ran.json()["methods"].size(), eval::methods().size());
  EXPECT_EQ(ran.json()["methods"][0]["method"], "direct");
  EXPECT_THAT(bytes(path("report/index.html")), HasSubstr("limber stream"));
}

TEST_F(CompareVerb, LeavesOutAMethodThatCannotTakeTheClipUnlessItIsNamed) {
  if (std::ranges::all_of(eval::methods(), [](const eval::MethodInfo& info) { return info.check == nullptr; }))
    GTEST_SKIP() << "every method of this build takes every clip";
  write(path("fin.obj"), square_with_a_fin());
  const std::vector<std::string> all{"compare", path("fin.obj"), "--vertices", "40", "--samples", "500",
                                     "-o",      path("report"),  "--json"};
  const Ran ran = run(all);
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  const std::string page = bytes(path("report/index.html"));
  std::size_t left_out = 0;
  for (const eval::MethodInfo& method : eval::methods()) {
    if (method.check == nullptr) continue;
    const std::string name(method.name);
    ++left_out;
    EXPECT_THAT(ran.err, HasSubstr(name + " is left out, it cannot take this clip: edge between"));
    EXPECT_THAT(page, HasSubstr("<code>" + name + "</code> is left out"));
    std::vector<std::string> named = all;
    named.insert(named.end(), {"--method", "direct," + name, "-f"});
    EXPECT_EQ(run(named).exit, Exit::kBadInput);
  }
  EXPECT_EQ(json["methods"].size(), eval::methods().size() - left_out);
  EXPECT_EQ(json["run"]["left_out"].size(), left_out);
  EXPECT_EQ(markup_fault(page), "");
}

TEST_F(CompareVerb, AnExistingReportStaysWithoutForce) {
  std::filesystem::create_directory(path("report"));
  write(path("report/report.json"), "mine");
  std::vector<std::string> arguments = two_methods(path("report"));
  const Ran ran = run(arguments);
  EXPECT_EQ(ran.exit, Exit::kFailure);
  EXPECT_EQ(in_folder(path("report")), std::vector<std::string>{"report.json"});
  EXPECT_EQ(bytes(path("report/report.json")), "mine");
  arguments.push_back("-f");
  EXPECT_EQ(run(arguments).exit, Exit::kDone);
  EXPECT_NE(bytes(path("report/report.json")), "mine");
}

TEST_F(CompareVerb, AFailureLeavesNoFolderBehind) {
  std::vector<std::string> arguments = two_methods(path("deep/report"));
  arguments[1] = path("missing/%04d.obj");
  EXPECT_EQ(run(arguments).exit, Exit::kBadInput);
  EXPECT_TRUE(names().empty());
}

TEST_F(CompareVerb, AFileIsNoFolder) {
  write(path("report"), "mine");
  EXPECT_EQ(run(two_methods(path("report"))).exit, Exit::kFailure);
  EXPECT_EQ(bytes(path("report")), "mine");
}

TEST_F(CompareVerb, SweepsAParameterOfAMethodThatNeedNotBeAmongThoseCompared) {
  std::vector<std::string> arguments = two_methods(path("report"));
  arguments.insert(arguments.end(), {"--sweep", "unified=1,0.5", "--sweep", "threshold=0,0.05", "--json"});
  const Ran ran = run(arguments);
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  ASSERT_EQ(json["sweeps"].size(), 2u);
  EXPECT_EQ(json["sweeps"][0]["parameter"], "unified");
  EXPECT_EQ(json["sweeps"][0]["method"], "feature");
  EXPECT_EQ(json["sweeps"][0]["used"], 0.96);
  EXPECT_EQ(json["sweeps"][0]["points"][0]["value"], 0.5);
  // With all contractions in common no triangle ever changes.
  EXPECT_EQ(json["sweeps"][0]["points"][1]["changed"], 0.0);
  EXPECT_GT(json["sweeps"][0]["points"][0]["changed"], 0.0);
  EXPECT_GT(json["sweeps"][1]["points"][0]["choice_bytes_per_frame"], 0.0);
  const std::string page = bytes(path("report/index.html"));
  EXPECT_EQ(markup_fault(page), "");
  EXPECT_THAT(page, HasSubstr("--sweep unified=1,0.5 --sweep threshold=0,0.05"));
  EXPECT_THAT(page, HasSubstr("limber simplify &#39;sample:gallop?vertices=600&amp;frames=3&#39; --vertices 80"));
}

TEST_F(CompareVerb, AValueOfASweepIsWhatTheOptionGives) {
  std::vector<std::string> arguments = {"compare",     "sample:gallop?vertices=600&frames=2",
                                        "--method",    "direct,feature",
                                        "--vertices",  "80",
                                        "--samples",   "2000",
                                        "--k1",        "2",
                                        "--sweep",     "k1=2,0",
                                        "--json",      "-o",
                                        path("report")};
  const auto json = run(arguments).json();
  EXPECT_EQ(json["sweeps"][0]["points"][1]["rms"], json["methods"][1]["rms"]);
  EXPECT_EQ(json["sweeps"][0]["used"], 2.0);
}

TEST_F(CompareVerb, CountsTheTrianglesOfAPart) {
  std::vector<std::string> arguments = two_methods(path("report"));
  arguments.insert(arguments.end(), {"--part", "everything=0,0,0,1000", "--figures", "--json"});
  const Ran ran = run(arguments);
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  EXPECT_EQ(json["parts"][0]["original_triangles"], json["clip"]["triangles"]);
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(json["parts"][0]["methods"][m]["triangles_last_frame"], json["methods"][m]["frames"][2]["triangles"]);
    const double part = json["parts"][0]["methods"][m]["rms"], all = json["methods"][m]["rms"];
    EXPECT_NEAR(part, all, 0.15 * all);
  }
  const std::string page = bytes(path("report/index.html"));
  EXPECT_EQ(markup_fault(page), "");
  EXPECT_THAT(page, HasSubstr("<section id=\"parts\">"));
  for (const char* const name : {"rms.svg", "part-everything.png", "frame-0000.png"})
    EXPECT_TRUE(std::filesystem::exists(path("report/") + name)) << name;
}

TEST_F(CompareVerb, APartWhereNothingIsIsRefused) {
  std::vector<std::string> arguments = two_methods(path("report"));
  arguments.insert(arguments.end(), {"--part", "tail=1000,0,0,1"});
  const Ran ran = run(arguments);
  EXPECT_EQ(ran.exit, Exit::kBadInput);
  EXPECT_THAT(ran.err, HasSubstr("tail"));
  EXPECT_TRUE(names().empty());
}

TEST_F(CompareVerb, ArgumentsThatMakeNoSenseAreRefused) {
  const auto exit = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"compare", kSample});
    return run(arguments).exit;
  };
  EXPECT_EQ(exit({"--vertices", "80"}), Exit::kUsage);
  EXPECT_EQ(exit({"-o", path("report")}), Exit::kUsage);
  EXPECT_EQ(exit({"--vertices", "80", "-o", "-"}), Exit::kUsage);
  EXPECT_EQ(exit({"--vertices", "80", "--method", "best", "-o", path("report")}), Exit::kUsage);
  EXPECT_EQ(exit({"--vertices", "80", "--view", "inside", "-o", path("report")}), Exit::kUsage);
  for (const char* const sweep :
       {"unified", "unified=", "unified=1", "unified=1,1", "unified=1,2", "unified=1,a", "unified=1,0.5,", "k=1,2"})
    EXPECT_EQ(exit({"--vertices", "80", "--sweep", sweep, "-o", path("report")}), Exit::kUsage) << sweep;
  for (const char* const part :
       {"ear", "=1,2,3,4", "ear=1,2,3", "ear=1,2,3,4,5", "ear=1,2,3,0", "ear=1,,3,4", "../ear=1,2,3,4"})
    EXPECT_EQ(exit({"--vertices", "80", "--part", part, "-o", path("report")}), Exit::kUsage) << part;
  EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace limber::test
