// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <gtest/gtest.h>

#include "limber/clip/mesh_file.h"
#include "limber/stream/build_height_field.h"
#include "tests/tool/run.h"

namespace limber::test {
namespace {

class FourFaceTool : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    const Ran made = run({"build", "--structure", "four-face", "sample:gallop?vertices=800&frames=6", "-o", file()});
    ASSERT_EQ(made.exit, tool::Exit::kDone) << made.err;
  }
  std::string file() const { return path("gallop.limber"); }
};

TEST_F(FourFaceTool, BuildsAFileThatIsSound) {
  EXPECT_EQ(run({"check", file()}).exit, tool::Exit::kDone);
  const auto info = run({"info", file(), "--json"}).json();
  EXPECT_EQ(info["frames"], 6);
  EXPECT_EQ(info["complete"], true);
  EXPECT_EQ(info["schema"], "limber.info_four_face/1");
}

TEST_F(FourFaceTool, FindsDamage) {
  std::string damaged = bytes(file());
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 4);
  write(path("damaged.limber"), damaged);
  EXPECT_NE(run({"check", path("damaged.limber")}).exit, tool::Exit::kDone);
  write(path("cut.limber"), bytes(file()).substr(0, damaged.size() - 20));
  const Ran cut = run({"check", path("cut.limber")});
  EXPECT_EQ(cut.exit, tool::Exit::kCheckFailed);
  EXPECT_NE(cut.out.find("whole"), std::string::npos);
}

TEST_F(FourFaceTool, ExtractsByVerticesTrianglesErrorAndLevel) {
  const auto count = [&](const std::string& option, const std::string& value, const char* what) {
    const Ran ran = run({"extract", file(), "--frame", "0", option, value, "--json"});
    EXPECT_EQ(ran.exit, tool::Exit::kDone) << ran.err;
    return ran.json()["frames"][0][what].get<int>();
  };
  EXPECT_LE(count("--vertices", "100", "vertices"), 100);
  EXPECT_GE(count("--vertices", "100", "vertices"), 95);
  EXPECT_LE(count("--triangles", "150", "triangles"), 150);
  EXPECT_GT(count("--error", "0.1", "triangles"), count("--error", "1", "triangles"));
  EXPECT_GT(count("--level", "0", "triangles"), count("--level", "3", "triangles"));
}

TEST_F(FourFaceTool, ExtractsWhatIsSeenOrInFocusFinerThanTheRest) {
  const auto triangles = [&](std::vector<std::string> options) {
    std::vector<std::string> all{"extract", file(), "--frame", "0", "--json"};
    all.insert(all.end(), options.begin(), options.end());
    const Ran ran = run(all);
    EXPECT_EQ(ran.exit, tool::Exit::kDone) << ran.err;
    return ran.json()["frames"][0]["triangles"].get<int>();
  };
  const int finest = triangles({"--level", "0"});
  const int ball = triangles({"--focus", "0,0,0,0.2"});
  EXPECT_LT(ball, finest);
  const int near = triangles({"--eye", "0,0,3", "--target", "0,0,0", "--pixels", "2"});
  const int far = triangles({"--eye", "0,0,30", "--target", "0,0,0", "--pixels", "2"});
  EXPECT_GT(near, far);
  EXPECT_LT(triangles({"--eye", "0,0,3", "--target", "0,0,9", "--pixels", "0.001"}), finest / 4);
  EXPECT_GT(triangles({"--curvature", "10"}), triangles({"--curvature", "40"}));
}

TEST_F(FourFaceTool, WritesAMeshForEveryFrame) {
  const Ran ran = run({"extract", file(), "--vertices", "100", "-o", path("lod-%02d.obj")});
  ASSERT_EQ(ran.exit, tool::Exit::kDone) << ran.err;
  for (const char* const name : {"lod-00.obj", "lod-05.obj"}) EXPECT_TRUE(std::filesystem::exists(path(name))) << name;
}

TEST_F(FourFaceTool, RefusesWhatDoesNotFitTogether) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--eye", "0,0,3"},
                                             {"--pixels", "2"},
                                             {"--eye", "0,0,3", "--target", "0,0,3"},
                                             {"--blend", "2"},
                                             {"--eye", "0,0,3", "--target", "0,0,0", "--size", "12"},
                                             {"--focus", "0,0,0,-1"},
                                             {"--vertices", "9", "--curvature", "9"}}) {
    std::vector<std::string> all{"extract", file(), "--frame", "0"};
    all.insert(all.end(), options.begin(), options.end());
    EXPECT_EQ(run(all).exit, tool::Exit::kUsage) << options.front();
  }
  EXPECT_EQ(run({"extract", file(), "--frame", "9"}).exit, tool::Exit::kBadInput);
  EXPECT_EQ(run({"build", "--structure", "four-face", "--levels", "9", "sample:flag", "-o", path("a.limber")}).exit,
            tool::Exit::kUsage);
}

// A file of several parts: what is larger than memory.
class PartsTool : public ToolTest {
 protected:
  void SetUp() override {
    ToolTest::SetUp();
    HeightField field{.width = 60, .depth = 40, .lowest = -3, .highest = 3, .read = {}};
    field.read = [](Index row, Index column, std::span<float> heights) {
      for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] = std::sin(0.3f * static_cast<float>(column + i)) * std::cos(0.2f * static_cast<float>(row));
      return Result<void>();
    };
    std::string bytes;
    const auto made = build_height_field(field, {.tile = 16, .tile_share = 0.1}, [&](std::span<const std::byte> more) {
      bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
      return Result<void>();
    });
    ASSERT_TRUE(made);
    write(file(), bytes);
  }
  std::string file() const { return path("field.limber"); }
  int triangles(std::vector<std::string> options) {
    options.insert(options.begin(), {"extract", file(), "--json"});
    const Ran ran = run(options);
    EXPECT_EQ(ran.exit, tool::Exit::kDone) << ran.err;
    return ran.json()["frames"][0]["triangles"].get<int>();
  }
};

TEST_F(PartsTool, SaysWhatIsInTheFileAndThatItIsSound) {
  EXPECT_EQ(run({"check", file()}).exit, tool::Exit::kDone);
  const auto info = run({"info", file(), "--json"}).json();
  EXPECT_EQ(info["vertices"], 60 * 40);
  EXPECT_EQ(info["triangles"], 2 * 59 * 39);
  EXPECT_EQ(info["parts"], 13);
}

TEST_F(PartsTool, ExtractsByTrianglesErrorViewAndRegion) {
  EXPECT_LE(triangles({"--triangles", "500"}), 500);
  EXPECT_GT(triangles({"--error", "0.1"}), triangles({"--error", "1"}));
  EXPECT_EQ(triangles({"--level", "0"}), 2 * 59 * 39);
  EXPECT_LT(triangles({"--focus", "10,0,10,6"}), 2 * 59 * 39);
  EXPECT_GT(triangles({"--eye", "30,9,50", "--target", "30,0,20", "--pixels", "1"}),
            triangles({"--eye", "30,90,500", "--target", "30,0,20", "--pixels", "1"}));
  ASSERT_EQ(run({"extract", file(), "--triangles", "500", "-o", path("field.ply")}).exit, tool::Exit::kDone);
  const auto mesh = read_mesh(path("field.ply"));
  ASSERT_TRUE(mesh);
  EXPECT_LE(mesh->mesh.triangles.size(), 500u);
}

TEST_F(PartsTool, RefusesWhatNeedsTheWholeFileInMemory) {
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--curvature", "9"}, {"--level", "2"}, {"--triangles", "9", "--focus", "0,0,0,1"}, {"-o", path("a.png")}}) {
    std::vector<std::string> all{"extract", file()};
    all.insert(all.end(), options.begin(), options.end());
    EXPECT_EQ(run(all).exit, tool::Exit::kUsage) << options.front();
  }
}

}  // namespace
}  // namespace limber::test
