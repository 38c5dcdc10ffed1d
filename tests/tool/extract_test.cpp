// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "limber/clip/mesh_file.h"
#include "tests/tool/run.h"

namespace limber::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing::UnorderedElementsAre;
using tool::Exit;
using ExtractVerb = ToolTest;
using RenderVerb = ToolTest;

TEST_F(ExtractVerb, WritesALevelOfOneFrame) {
  const std::string file = stream();
  for (const char* const name : {"a.obj", "a.ply", "a.off"}) {
    const Ran ran = run({"extract", file, "--frame", "3", "--vertices", "100", "-o", path(name), "--json"});
    ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
    const auto mesh = read_mesh(path(name));
    ASSERT_TRUE(mesh);
    const auto frame = ran.json()["frames"][0];
    EXPECT_EQ(frame["frame"], 3);
    EXPECT_EQ(frame["vertices"], mesh->mesh.vertex_count);
    EXPECT_EQ(frame["triangles"], mesh->mesh.triangles.size());
    EXPECT_GT(frame["estimated_error"], 0);
    EXPECT_LE(mesh->mesh.vertex_count, 100u);
  }
  EXPECT_THAT(bytes(path("a.obj")), HasSubstr("vn "));
}

TEST_F(ExtractVerb, NumbersAllFramesAsTheInputWas) {
  const Ran built = run({"build", kSample, "--first", "2", "--last", "4", "-o", path("a.limber"), "-q"});
  ASSERT_EQ(built.exit, Exit::kDone) << built.err;
  ASSERT_EQ(run({"extract", path("a.limber"), "--triangles", "150", "-o", path("lod/%03d.off")}).exit, Exit::kDone);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path("lod"))) names.push_back(entry.path().filename());
  EXPECT_THAT(names, UnorderedElementsAre("002.off", "003.off", "004.off"));
}

TEST_F(ExtractVerb, TheFinestLevelIsTheInput) {
  ASSERT_EQ(run({"extract", stream("a.limber", {"--lossless"}), "--frame", "5", "-o", path("a.ply")}).exit,
            Exit::kDone);
  ASSERT_EQ(run({"convert", kSample, "--first", "5", "--last", "5", "-o", path("b.ply")}).exit, Exit::kDone);
  const auto extracted = read_mesh(path("a.ply")), converted = read_mesh(path("b.ply"));
  EXPECT_EQ(extracted->mesh, converted->mesh);
  EXPECT_EQ(extracted->positions, converted->positions);
}

TEST_F(ExtractVerb, LooksFromAnEye) {
  const std::string file = stream();
  const auto extracted = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command = {"extract", file, "--frame", "3", "--json"};
    command.insert(command.end(), more.begin(), more.end());
    const Ran ran = run(command);
    EXPECT_EQ(ran.exit, Exit::kDone) << ran.err;
    return ran.json()["frames"][0];
  };
  const std::vector<std::string> eye = {"--eye", "0,0,5", "--target", "0,0,0", "--size", "800x600"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), eye.begin(), eye.end());
    return extracted(more);
  };
  const auto close = with({"--pixels", "1"}), rough = with({"--pixels", "8", "--fov", "40"});
  EXPECT_LE(close["seen_error"], 1);
  EXPECT_LE(rough["seen_error"], 8);
  EXPECT_LT(rough["vertices"], close["vertices"]);
  const auto budget = with({"--vertices", "100", "--pixels", "0.01"});
  EXPECT_LE(budget["vertices"], 100);
  EXPECT_GT(budget["vertices"], 80);
  EXPECT_LE(with({"--vertices", "100", "--pixels", "500"})["vertices"], budget["vertices"]);
  EXPECT_LE(with({"--pixels", "8", "--facing-away", "8", "--estimate"})["vertices"], close["vertices"]);
  EXPECT_EQ(with({"--pixels", "8", "-o", path("a.obj")})["frame"], 3);
}

TEST_F(ExtractVerb, RefinesAlongAnAxisOrAroundAFocus) {
  const std::string file = stream();
  for (const std::vector<std::string>& look :
       {std::vector<std::string>{"--along", "x:-0.5:0.5"}, std::vector<std::string>{"--focus", "0,0,0,0.3"}}) {
    std::vector<std::string> command = {"extract", file, "--frame", "3", "--vertices", "120", "--json"};
    command.insert(command.end(), look.begin(), look.end());
    const Ran ran = run(command);
    ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
    EXPECT_LE(ran.json()["frames"][0]["vertices"], 120);
    EXPECT_GT(ran.json()["frames"][0]["seen_error"], 0);
  }
}

TEST_F(ExtractVerb, SaysWhatAViewLacks) {
  const std::string file = stream();
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> command = {"extract", file, "--frame", "3"};
    command.insert(command.end(), more.begin(), more.end());
    const Ran ran = run(command);
    EXPECT_EQ(ran.exit, Exit::kUsage);
    return ran.err;
  };
  EXPECT_THAT(refused({"--eye", "0,0,5", "--pixels", "1"}), HasSubstr("--target"));
  EXPECT_THAT(refused({"--pixels", "1"}), HasSubstr("--eye"));
  EXPECT_THAT(refused({"--eye", "0,0,5", "--target", "0,0,0"}), HasSubstr("--pixels"));
  EXPECT_THAT(refused({"--eye", "0,0,5", "--target", "0,0,0", "--level", "1"}), HasSubstr("--level"));
  EXPECT_THAT(refused({"--eye", "0,0", "--target", "0,0,0", "--pixels", "1"}), HasSubstr("0,0 is no point"));
  EXPECT_THAT(refused({"--along", "w:1:2", "--vertices", "100"}), HasSubstr("w:1:2"));
  EXPECT_THAT(refused({"--focus", "1,2,3", "--vertices", "100"}), HasSubstr("1,2,3"));
}

TEST_F(ExtractVerb, WithoutAnOutputSaysWhatThereWouldBe) {
  const Ran ran = run({"extract", stream(), "--level", "1"});
  EXPECT_EQ(ran.exit, Exit::kDone);
  EXPECT_THAT(ran.out, HasSubstr("asked for level 1: 300 vertices"));
}

TEST_F(ExtractVerb, AnErrorBoundIsKeptApproximately) {
  const std::string file = stream();
  const auto loose = run({"extract", file, "--frame", "0", "--error", "1", "--json"}).json()["frames"][0];
  const auto tight = run({"extract", file, "--frame", "0", "--error", "0.2", "--json"}).json()["frames"][0];
  EXPECT_LT(loose["vertices"], tight["vertices"]);
  EXPECT_LE(tight["estimated_error"], 0.2);
}

TEST_F(ExtractVerb, TakesPicturesOfALevel) {
  const std::string file = stream();
  const Ran ran = run({"extract", file, "--frame", "2", "--vertices", "90", "--size", "60x40", "--side-by-side",
                       "--error-colors", "--view", "20,10", "-o", path("a.png"), "--json"});
  ASSERT_EQ(ran.exit, Exit::kDone) << ran.err;
  EXPECT_THAT(bytes(path("a.png")), StartsWith("\x89PNG"));
  EXPECT_GT(ran.json()["error_range"], 0);
  ASSERT_EQ(run({"extract", file, "--first", "1", "--last", "2", "--level", "1", "--size", "60x40", "--wireframe", "-o",
                 path("p/%d.png")})
                .exit,
            Exit::kDone);
  EXPECT_NE(bytes(path("p/1.png")), bytes(path("p/2.png")));
}

TEST_F(ExtractVerb, ArgumentsThatMakeNoSenseAreRefused) {
  const std::string file = stream();
  EXPECT_EQ(run({"extract", kSample, "-o", path("a.obj")}).exit, Exit::kUsage);
  EXPECT_EQ(run({"extract", file, "-o", path("a.obj")}).exit, Exit::kUsage);
  EXPECT_EQ(run({"extract", file, "--frame", "1", "-o", path("a.jpg")}).exit, Exit::kUsage);
  EXPECT_EQ(run({"extract", file, "--frame", "1", "--flat", "-o", path("a.obj")}).exit, Exit::kUsage);
  EXPECT_EQ(run({"extract", file, "--frame", "1", "--view", "inside", "-o", path("a.png")}).exit, Exit::kUsage);
  EXPECT_EQ(run({"extract", file, "--frame", "8", "-o", path("a.obj")}).exit, Exit::kBadInput);
  EXPECT_EQ(run({"extract", path("none.limber"), "--frame", "8", "-o", path("a.obj")}).exit, Exit::kBadInput);
  EXPECT_EQ(names(), std::vector<std::string>{"a.limber"});
}

TEST_F(ExtractVerb, BlendsChangesBetweenFrames) {
  const std::string file = stream();
  const auto extract = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"extract", file, "--level", "1", "--json", "-o", path(name)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.exit, Exit::kDone) << ran.err;
    return ran.json();
  };
  const auto plain = extract("a%d.ply", {}), none = extract("b%d.ply", {"--blend", "0"});
  const auto blended = extract("c%d.ply", {"--blend", "4"});
  EXPECT_EQ(blended["blend"], 4);
  Index more = 0;
  for (std::size_t frame = 0; frame < plain["frames"].size(); ++frame) {
    const std::string number = std::to_string(frame) + ".ply";
    EXPECT_EQ(bytes(path("a" + number)), bytes(path("b" + number)));
    ASSERT_GE(blended["frames"][frame]["vertices"], plain["frames"][frame]["vertices"]);
    more += bytes(path("a" + number)) != bytes(path("c" + number));
    extract("d.ply", {"--frame", std::to_string(frame), "--blend", "4", "--force"});
    if (frame <= 4) {
      EXPECT_EQ(bytes(path("d.ply")), bytes(path("c" + number))) << "it is gone to as when playing";
    }
  }
  EXPECT_EQ(bytes(path("a0.ply")), bytes(path("c0.ply")));
  EXPECT_GT(more, 2u);
  extract("e%d.ply", {"--first", "3", "--blend", "4"});
  EXPECT_EQ(bytes(path("e5.ply")), bytes(path("c5.ply")));
  EXPECT_EQ(run({"measure", kSample, file, "--level", "1", "--blend", "3"}).exit, Exit::kDone);
  EXPECT_EQ(run({"measure", kSample, kSample, "--blend", "3"}).exit, Exit::kUsage);
}

TEST_F(ExtractVerb, AStreamThatIsCutOffGivesItsWholeFrames) {
  const std::string whole = bytes(stream());
  write(path("b.limber"), whole.substr(0, whole.size() * 2 / 3));
  const Ran ran = run({"extract", path("b.limber"), "--level", "1"});
  EXPECT_EQ(ran.exit, Exit::kDone);
  EXPECT_THAT(ran.err, HasSubstr("is cut off"));
}

TEST_F(RenderVerb, TakesPicturesOfClipsAndMeshes) {
  ASSERT_EQ(run({"render", kSample, "--size", "60x40", "-o", path("a.png")}).exit, Exit::kDone);
  ASSERT_EQ(run({"render", kSample, "--size", "60x40", "-j", "1", "-o", path("b.png")}).exit, Exit::kDone);
  EXPECT_EQ(bytes(path("a.png")), bytes(path("b.png")));
  EXPECT_EQ(run({"render", kSample, "--size", "60x40", "-o", path("a.png")}).exit, Exit::kFailure);
  const Ran all = run({"render", kSample, "--last", "1", "--size", "60x40", "-o", path("c/%d.png"), "--json"});
  ASSERT_EQ(all.exit, Exit::kDone) << all.err;
  EXPECT_EQ(all.json()["frames"].size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(path("c/1.png")));
}

TEST_F(RenderVerb, ErrorColorsNeedAnOriginal) {
  const std::vector<std::string> arguments = {"render", kSample, "--frame", "1",          "--error-colors",
                                              "--size", "60x40", "-o",      path("a.png")};
  EXPECT_EQ(run(arguments).exit, Exit::kUsage);
  std::vector<std::string> with_original = arguments;
  with_original.insert(with_original.end(), {"--original", kSample});
  EXPECT_EQ(run(with_original).exit, Exit::kDone);
}

}  // namespace
}  // namespace limber::test
