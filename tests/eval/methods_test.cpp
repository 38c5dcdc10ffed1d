// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "eval/methods/method.h"
#include "eval/methods/quadric_error.h"
#include "limber/clip/clip.h"

namespace limber::eval {
namespace {

// A small clip in memory, and all that a method gives for it.
class Methods : public testing::Test {
 protected:
  Methods() {
    const auto reader = open_clip("sample:gallop?vertices=400&frames=4", {});
    mesh_ = (*reader)->mesh();
    std::vector<Vec3f> positions(mesh_.vertex_count);
    while (*(*reader)->read(positions)) frames_.push_back(positions);
  }

  std::vector<Approximation> run(std::string_view name, const MethodOptions& options) const {
    const MethodInfo& info = *find_method(name);
    const auto method = info.create(options);
    const std::vector<std::span<const Vec3f>> seen(frames_.begin(), frames_.end());
    method->begin(mesh_, std::span(seen).first(info.sees == Sees::kFirst ? 1 : seen.size()));
    std::vector<Approximation> all(frames_.size());
    for (std::size_t t = 0; t < all.size(); ++t) method->frame(frames_[t], all[t]);
    return all;
  }

  double quadric_error(std::size_t t, const Approximation& made) const {
    return QuadricError(mesh_, {}).measure(frames_[t], made.clusters);
  }

  Mesh mesh_;
  std::vector<std::vector<Vec3f>> frames_;
};

TEST_F(Methods, AreFoundByName) {
  for (const MethodInfo& info : methods()) EXPECT_EQ(find_method(info.name), &info);
  EXPECT_EQ(find_method("best"), nullptr);
}

TEST_F(Methods, KeepToTheVertexCountAndGiveWholeMeshes) {
  for (const MethodInfo& info : methods()) {
    for (const Approximation& made : run(info.name, {.vertices = 100})) {
      EXPECT_LE(made.positions.size(), 100u) << info.name;
      EXPECT_GE(made.positions.size(), 90u) << info.name;
      EXPECT_FALSE(made.triangles.empty());
      ASSERT_EQ(made.nodes.size(), made.positions.size());
      EXPECT_EQ(std::set<Index>(made.nodes.begin(), made.nodes.end()).size(), made.nodes.size()) << info.name;
      if (!info.peer) {
        ASSERT_EQ(made.clusters.size(), mesh_.vertex_count);
      }
      for (const Triangle& t : made.triangles) EXPECT_LT(*std::ranges::max_element(t), made.positions.size());
      EXPECT_GT(made.adapt_seconds, 0) << info.name;
    }
  }
}

TEST_F(Methods, KeepToTheTriangleCount) {
  for (const MethodInfo& info : methods()) {
    const Approximation first = run(info.name, {.triangles = 200}).front();
    EXPECT_LE(first.triangles.size(), 200u) << info.name;
    EXPECT_GE(first.triangles.size(), 180u) << info.name;
  }
}

TEST_F(Methods, FirstFrameIsDirectInTheFirstFrameAndKeepsItsConnectivity) {
  const std::vector<Approximation> fixed = run("first-frame", {.vertices = 100});
  const std::vector<Approximation> direct = run("direct", {.vertices = 100});
  EXPECT_EQ(fixed[0].triangles, direct[0].triangles);
  EXPECT_EQ(fixed[0].nodes, direct[0].nodes);
  for (std::size_t i = 0; i < fixed[0].positions.size(); ++i)
    EXPECT_LT(length(fixed[0].positions[i] - direct[0].positions[i]), 1e-4f);
  for (const Approximation& made : fixed) {
    EXPECT_EQ(made.triangles, fixed[0].triangles);
    EXPECT_EQ(made.nodes, fixed[0].nodes);
  }
  EXPECT_NE(fixed[3].positions, fixed[0].positions);
}

TEST_F(Methods, SwapsOnTheSameFrameLowerTheQuadricError) {
  const std::vector<Approximation> direct = run("direct", {.vertices = 60});
  const std::vector<Approximation> improved = run("improved", {.vertices = 60});
  for (std::size_t t = 0; t < frames_.size(); ++t)
    EXPECT_LT(quadric_error(t, improved[t]), 0.95 * quadric_error(t, direct[t]));
}

TEST_F(Methods, MultilevelFollowsTheClip) {
  const std::vector<Approximation> fixed = run("first-frame", {.vertices = 60});
  const std::vector<Approximation> followed = run("multilevel", {.vertices = 60});
  EXPECT_LT(quadric_error(3, followed[3]), quadric_error(3, fixed[3]));
}

TEST_F(Methods, MultilevelCanBlendItsChanges) {
  const std::vector<Approximation> plain = run("multilevel", {.vertices = 100});
  const std::vector<Approximation> none = run("multilevel", {.vertices = 100, .blend = 1});
  const std::vector<Approximation> blended = run("multilevel", {.vertices = 100, .blend = 3});
  std::size_t more = 0;
  for (std::size_t t = 0; t < frames_.size(); ++t) {
    EXPECT_EQ(none[t].positions, plain[t].positions);
    EXPECT_EQ(none[t].triangles, plain[t].triangles);
    EXPECT_EQ(blended[t].clusters, plain[t].clusters) << "of the cut";
    ASSERT_GE(blended[t].positions.size(), plain[t].positions.size());
    more += blended[t].positions.size() - plain[t].positions.size();
  }
  EXPECT_EQ(blended[0].positions, plain[0].positions);
  EXPECT_GT(more, 0u);
}

TEST_F(Methods, IndependentFramesDependOnTheirPositionsAlone) {
  for (const MethodInfo& info : methods()) {
    if (!info.frames_are_independent) continue;
    const auto method = info.create({.vertices = 100});
    const std::span<const Vec3f> base[] = {frames_[0]};
    method->begin(mesh_, base);
    Approximation alone;
    method->frame(frames_[2], alone);
    const Approximation in_order = run(info.name, {.vertices = 100})[2];
    EXPECT_EQ(alone.positions, in_order.positions) << info.name;
    EXPECT_EQ(alone.triangles, in_order.triangles) << info.name;
  }
}

TEST_F(Methods, QuadricErrorIsNothingWhereEveryVertexIsByItself) {
  std::vector<Index> alone(mesh_.vertex_count), together(mesh_.vertex_count, 0);
  for (Index v = 0; v < mesh_.vertex_count; ++v) alone[v] = v;
  QuadricError error(mesh_, {});
  EXPECT_LT(error.measure(frames_[0], alone), 1e-6 * error.measure(frames_[0], together));
}

}  // namespace
}  // namespace limber::eval
