// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "eval/methods/method.h"
#include "limber/clip/mesh_file.h"
#include "tests/tool/fin.h"
#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using tool::Exit;
using SimplifyVerb = ToolTest;

TEST_F(SimplifyVerb, WritesAMeshPerFrame) {
  for (const eval::MethodInfo& method : eval::methods()) {
    const Ran ran = run(
        {"simplify", kSample, "--method", std::string(method.name), "--vertices", "80", "-o", path("%02d.ply"), "-f"});
    ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("8 frames by"));
    const auto mesh = read_mesh(path("07.ply"));
    ASSERT_TRUE(mesh);
    EXPECT_LE(mesh->mesh.vertex_count, 80u);
  }
}

TEST_F(SimplifyVerb, TheBytesDoNotDependOnTheThreads) {
  for (const char* const threads : {"1", "3"}) {
    ASSERT_EQ(run({"simplify", kSample, "--method", "direct", "--ratio", "0.2", "-j", threads, "-o",
                   path(std::string("%d-") + threads + ".obj")})
                  .exit,
              Exit::kDone);
  }
  for (int t = 0; t < 8; ++t)
    EXPECT_EQ(bytes(path(std::to_string(t) + "-1.obj")), bytes(path(std::to_string(t) + "-3.obj")));
}

TEST_F(SimplifyVerb, MeasuresMethodsSideBySide) {
  const Ran ran = run({"simplify", kSample, "--method", "direct,multilevel", "--vertices", "80", "--measure",
                       "--samples", "2000", "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  const auto json = ran.json();
  EXPECT_EQ(json["schema"], "limber.simplify/1");
  EXPECT_EQ(json["asked"]["vertices"], 80);
  ASSERT_EQ(json["methods"].size(), 2u);
  EXPECT_EQ(json["methods"][1]["relative"]["to"], "direct");
  EXPECT_GT(json["methods"][1]["relative"]["rms"], 0.5);
  EXPECT_LT(json["methods"][1]["relative"]["rms"], 2);
  EXPECT_EQ(json["methods"][1]["frames"].size(), 8u);
}

TEST_F(SimplifyVerb, SwapsImproveAStaticMesh) {
  const auto json = run({"simplify", "sample:gallop?vertices=1500&frames=1", "--method", "direct,improved",
                         "--vertices", "100", "--measure", "--samples", "2000", "--json"})
                        .json();
  EXPECT_LT(json["methods"][1]["relative"]["quadric_error"], 0.85);
}

TEST_F(SimplifyVerb, AnExistingOutputStaysWithoutForce) {
  write(path("0001.obj"), "mine");
  const Ran ran = run({"simplify", kSample, "--method", "direct", "--vertices", "80", "-o", path("%04d.obj")});
  EXPECT_EQ(ran.exit, Exit::kFailure);
  EXPECT_EQ(names(), std::vector<std::string>{"0001.obj"});
}

TEST_F(SimplifyVerb, AMethodThatCannotTakeTheClipIsBadInput) {
  write(path("fin.obj"), square_with_a_fin());
  for (const eval::MethodInfo& method : eval::methods()) {
    const Ran ran =
        run({"simplify", path("fin.obj"), "--method", std::string(method.name), "--vertices", "40", "--measure"});
    EXPECT_EQ(ran.exit, method.check == nullptr ? Exit::kDone : Exit::kBadInput) << method.name;
    if (method.check == nullptr) continue;
    EXPECT_THAT(ran.err, HasSubstr("fin.obj: " + std::string(method.name) +
                                   " cannot take this clip: edge between "
                                   "vertices 40 and 41: lies on 3 triangles"));
  }
}

TEST_F(SimplifyVerb, AMissingPeerNamesWhatToInstall) {
  for (const char* const name : {"meshoptimizer", "cgal-lindstrom-turk", "cgal-garland-heckbert"}) {
    if (eval::find_method(name) != nullptr) continue;
    const Ran ran = run({"simplify", kSample, "--method", name, "--vertices", "80", "--measure"});
    EXPECT_EQ(ran.exit, Exit::kUsage);
    EXPECT_THAT(ran.err, HasSubstr("built without "));
  }
}

TEST_F(SimplifyVerb, PlacementByVolumeIsTheMethodOfThatName) {
  ASSERT_EQ(run({"simplify", kSample, "--method", "direct", "--placement", "volume", "--vertices", "80", "-o",
                 path("a%d.obj")})
                .exit,
            Exit::kDone);
  ASSERT_EQ(run({"simplify", kSample, "--method", "direct-volume", "--vertices", "80", "-o", path("b%d.obj")}).exit,
            Exit::kDone);
  for (const char* const frame : {"0.obj", "7.obj"})
    EXPECT_EQ(bytes(path(std::string("a") + frame)), bytes(path(std::string("b") + frame)));
}

TEST_F(SimplifyVerb, ArgumentsThatMakeNoSenseAreRefused) {
  const auto exit = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"simplify", kSample});
    return run(arguments).exit;
  };
  EXPECT_EQ(exit({"--method", "best", "--vertices", "80", "--measure"}), Exit::kUsage);
  EXPECT_EQ(exit({"--method", "direct", "--measure"}), Exit::kUsage);
  EXPECT_EQ(exit({"--method", "direct", "--vertices", "80"}), Exit::kUsage);
  EXPECT_EQ(exit({"--method", "direct", "--vertices", "80", "--ratio", "0.5", "--measure"}), Exit::kUsage);
  EXPECT_EQ(exit({"--method", "direct", "--ratio", "1.5", "--measure"}), Exit::kUsage);
  EXPECT_EQ(exit({"--method", "direct,multilevel", "--vertices", "80", "-o", "a%d.obj"}), Exit::kUsage);
  EXPECT_EQ(exit({"--method", "direct,multilevel", "--placement", "volume", "--vertices", "80", "--measure"}),
            Exit::kUsage);
  EXPECT_EQ(exit({"--method", "direct", "--placement", "linear", "--vertices", "80", "--measure"}), Exit::kUsage);
  EXPECT_EQ(exit({"--method", "multilevel", "--levels", "80,90", "--vertices", "80", "--measure"}), Exit::kUsage);
}

}  // namespace
}  // namespace limber::test
