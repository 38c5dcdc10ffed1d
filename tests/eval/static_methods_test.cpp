// SPDX-License-Identifier: Apache-2.0
// The laws of the methods that decide once for the whole clip.
#include <algorithm>
#include <gtest/gtest.h>

#include "eval/methods/method.h"
#include "eval/methods/quadric_error.h"
#include "limber/clip/clip.h"

namespace limber::eval {
namespace {

using Frames = std::vector<std::vector<Vec3f>>;

class StaticMethods : public testing::Test {
 protected:
  // Made once: the clip takes seconds.
  static void SetUpTestSuite() {
    if (!frames_.empty()) return;
    const auto reader = open_clip("sample:collapse?vertices=600&frames=6", {});
    mesh_ = (*reader)->mesh();
    std::vector<Vec3f> positions(mesh_.vertex_count);
    while (*(*reader)->read(positions)) frames_.push_back(positions);
  }

  static std::vector<Approximation> run(std::string_view name, const Frames& frames) {
    const MethodInfo& info = *find_method(name);
    const auto method = info.create({.vertices = 80});
    const std::vector<std::span<const Vec3f>> seen(frames.begin(), frames.end());
    method->begin(mesh_, std::span(seen).first(info.sees == Sees::kFirst ? 1 : seen.size()));
    std::vector<Approximation> all(frames.size());
    for (std::size_t t = 0; t < all.size(); ++t) method->frame(frames[t], all[t]);
    return all;
  }

  static std::vector<double> quadric_errors(std::string_view name) {
    QuadricError error(mesh_, {});
    std::vector<double> errors;
    const std::vector<Approximation> all = run(name, frames_);
    for (std::size_t t = 0; t < all.size(); ++t) errors.push_back(error.measure(frames_[t], all[t].clusters));
    return errors;
  }

  // The first frame, and the same turned and moved.
  static Frames rigid_motion() {
    Frames frames{frames_[0], frames_[0], frames_[0]};
    for (Vec3f& p : frames[1]) p = {-p.y, p.x, p.z};
    for (Vec3f& p : frames[2]) p = Vec3f{p.z, p.x, p.y};
    return frames;
  }

  static inline Mesh mesh_;
  static inline Frames frames_;
};

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

TEST_F(StaticMethods, KeepTheirTrianglesAndClusters) {
  for (const char* const name :
       {"first-frame", "rest-pose", "four-face", "dsd", "average", "pose-independent", "deformation-oriented"}) {
    const std::vector<Approximation> all = run(name, frames_);
    for (const Approximation& made : all) {
      EXPECT_EQ(made.triangles, all[0].triangles) << name;
      EXPECT_EQ(made.nodes, all[0].nodes) << name;
      EXPECT_EQ(made.clusters, all[0].clusters) << name;
    }
    EXPECT_NE(all[5].positions, all[0].positions) << name;
  }
}

TEST_F(StaticMethods, RestPoseShowsVerticesOfTheInputInEveryFrame) {
  const std::vector<Approximation> all = run("rest-pose", frames_);
  const std::vector<Approximation> placed = run("first-frame", frames_);
  for (std::size_t t = 0; t < all.size(); ++t) {
    EXPECT_EQ(all[t].triangles, placed[t].triangles);
    EXPECT_EQ(all[t].clusters, placed[t].clusters);
    for (std::size_t i = 0; i < all[t].nodes.size(); ++i) {
      EXPECT_EQ(all[t].positions[i], frames_[t][all[t].nodes[i]]);
      EXPECT_EQ(all[t].clusters[all[t].nodes[i]], placed[t].nodes[i]) << "of its own cluster";
    }
  }
}

TEST_F(StaticMethods, FourFaceShowsVerticesOfTheInputInEveryFrame) {
  const std::vector<Approximation> all = run("four-face", frames_);
  EXPECT_EQ(all[0].positions.size(), 80u);
  for (std::size_t t = 0; t < all.size(); ++t)
    for (std::size_t i = 0; i < all[t].nodes.size(); ++i) EXPECT_EQ(all[t].positions[i], frames_[t][all[t].nodes[i]]);
}

TEST_F(StaticMethods, SeeingAllFramesIsBetterThanSeeingTheFirst) {
  const std::vector<double> first = quadric_errors("first-frame"), by_sum = quadric_errors("dsd");
  for (const char* const name : {"dsd", "average", "pose-independent", "deformation-oriented", "best-cut"})
    EXPECT_LT(sum(quadric_errors(name)), 0.9 * sum(first)) << name;
  EXPECT_LT(std::ranges::max(quadric_errors("average")), std::ranges::max(first));
}

TEST_F(StaticMethods, DsdAndAverageAgreeWhereAllFramesAreEqual) {
  const Frames same{frames_[0], frames_[0]};
  EXPECT_EQ(run("dsd", same)[1].clusters, run("average", same)[1].clusters);
}

TEST_F(StaticMethods, ARigidMotionTellsNothingNew) {
  QuadricError error(mesh_, {});
  const Frames frames = rigid_motion();
  const double first = error.measure(frames[0], run("first-frame", frames)[0].clusters);
  EXPECT_NEAR(error.measure(frames[0], run("pose-independent", frames)[0].clusters), first, 0.02 * first);
  const double by_sum = error.measure(frames[0], run("dsd", frames)[0].clusters);
  EXPECT_NEAR(error.measure(frames[0], run("deformation-oriented", frames)[0].clusters), by_sum, 0.02 * by_sum);
}

TEST_F(StaticMethods, BestCutChangesWithTheFrameAndRestsWhenItDoes) {
  Frames frames = frames_;
  frames.push_back(frames.back());
  const std::vector<Approximation> all = run("best-cut", frames);
  EXPECT_NE(all[0].clusters, all[5].clusters);
  EXPECT_EQ(all[5].clusters, all[6].clusters);
  EXPECT_EQ(all[5].positions, all[6].positions);
}

TEST_F(StaticMethods, BestCutIsBetterThanDsdAndInNoFrameMuchWorse) {
  const std::vector<double> cut = quadric_errors("best-cut"), by_sum = quadric_errors("dsd");
  for (std::size_t t = 0; t < cut.size(); ++t) EXPECT_LT(cut[t], 1.1 * by_sum[t]) << t;
  EXPECT_LT(sum(cut), sum(by_sum));
}

}  // namespace
}  // namespace limber::eval
