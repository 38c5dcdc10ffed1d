// SPDX-License-Identifier: Apache-2.0
#include "eval/comparison.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "limber/clip/clip.h"

namespace limber::eval {
namespace {

const ClipMeasureOptions kFew{.distance = {.samples = {.per_triangle = 0, .at_least = 2000}}, .first_frame_number = 5};

Result<void> compare(Comparison& comparison, std::span<const MethodInfo* const> methods, Mesh& mesh) {
  const auto reader = open_clip("sample:gallop?vertices=400&frames=3", {});
  mesh = (*reader)->mesh();
  comparison.begin(mesh, *SeenFrames::read(**reader, methods, 2, [](std::uint32_t) { return true; }));
  std::vector<Vec3f> positions(mesh.vertex_count);
  while (*(*reader)->read(positions)) {
    if (Result<void> added = comparison.add(positions); !added) return added;
  }
  return {};
}

TEST(Comparison, HoldsEveryMethodAgainstTheFirst) {
  const MethodInfo* const methods[] = {find_method("direct"), find_method("first-frame")};
  Comparison comparison(methods, {.vertices = 60}, kFew);
  Mesh mesh;
  ASSERT_TRUE(compare(comparison, methods, mesh));
  const Relative self = comparison.relative(0), other = comparison.relative(1);
  EXPECT_EQ(self.rms_by_mean, 1);
  EXPECT_EQ(self.rms_worst, 1);
  EXPECT_NEAR(self.rms_by_frame, 1, 1e-12);
  EXPECT_GT(other.quadric_error, 1);
  EXPECT_GE(other.rms_worst, other.rms_by_frame);

  const auto json = comparison_json(comparison);
  EXPECT_EQ(json["schema"], "limber.simplify/1");
  ASSERT_EQ(json["methods"].size(), 2u);
  EXPECT_EQ(json["methods"][1]["method"], "first-frame");
  EXPECT_EQ(json["methods"][1]["changed"], 0);
  EXPECT_GT(json["methods"][0]["changed"], 0);
  EXPECT_EQ(json["methods"][0]["frames"][2]["frame"], 7);
  EXPECT_LE(json["methods"][0]["frames"][2]["vertices"], 60);
  EXPECT_NE(comparison_table(comparison).find("relative to direct"), std::string::npos);
}

// As direct, but keeps its clusters to itself.
class Silent final : public Method {
 public:
  explicit Silent(const MethodOptions& options) : direct_(find_method("direct")->create(options)) {}
  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override { direct_->begin(mesh, seen); }
  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    direct_->frame(positions, out);
    out.clusters.clear();
  }

 private:
  std::unique_ptr<Method> direct_;
};

TEST(Comparison, AMethodThatDoesNotTellItsClustersHasNoQuadricError) {
  const auto make = [](const MethodOptions& options) -> std::unique_ptr<Method> {
    return std::make_unique<Silent>(options);
  };
  const MethodInfo silent{"silent", "", true, Sees::kFirst, make};
  for (const bool silent_first : {false, true}) {
    const MethodInfo* methods[] = {find_method("direct"), &silent};
    if (silent_first) std::swap(methods[0], methods[1]);
    Comparison comparison(methods, {.vertices = 60}, kFew);
    Mesh mesh;
    ASSERT_TRUE(compare(comparison, methods, mesh));
    EXPECT_FALSE(comparison.relative(1).quadric_error);
    EXPECT_EQ(comparison.relative(1).rms_by_mean, 1);
    const auto json = comparison_json(comparison);
    const auto &known = json["methods"][silent_first ? 1 : 0], &unknown = json["methods"][silent_first ? 0 : 1];
    EXPECT_TRUE(known["quadric_error"]["mean"].is_number());
    EXPECT_TRUE(known["frames"][0]["quadric_error"].is_number());
    EXPECT_TRUE(unknown["quadric_error"].is_null());
    EXPECT_TRUE(unknown["frames"][2]["quadric_error"].is_null());
    EXPECT_TRUE(unknown["relative"]["quadric_error"].is_null());
    EXPECT_NE(comparison_table(comparison).find(" -  "), std::string::npos);
  }
}

TEST(Comparison, AMethodThatLeavesNothingIsAnError) {
  const MethodInfo* const methods[] = {find_method("direct")};
  MethodOptions options{.vertices = 2};
  options.contract.topology = Topology::kFree;
  Comparison comparison(methods, options, kFew);
  Mesh mesh;
  const Result<void> compared = compare(comparison, methods, mesh);
  ASSERT_FALSE(compared);
  EXPECT_EQ(compared.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(compared.error().where, "frame 5");
}

}  // namespace
}  // namespace limber::eval
