// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "eval/methods/feature_quadrics.h"
#include "eval/methods/feature_suffix.h"
#include "eval/methods/feature_unified.h"
#include "eval/methods/method.h"
#include "tests/eval/gallop.h"

namespace limber::eval {
namespace {

class Feature : public Gallop {
 protected:
  static std::vector<Approximation> run(const FeatureOptions& feature, Index vertices = 200) {
    return Gallop::run("feature", {.vertices = vertices, .feature = feature}, seen_, frames_);
  }

  static UnifiedMesh unified(const FeatureOptions& feature) {
    const MethodOptions options{.vertices = 200, .feature = feature};
    FeatureQuadrics quadrics(mesh_, seen_.front(), seen_.back(), options);
    return contract_unified(mesh_, seen_, quadrics, options);
  }
};

TEST_F(Feature, EveryFrameGoesOnFromTheUnifiedMesh) {
  const UnifiedMesh prefix = unified({});
  const std::vector<Approximation> all = run({});
  for (const Approximation& made : all) {
    EXPECT_EQ(made.positions.size(), 200u);
    // What was one cluster in the unified mesh is not divided in any frame.
    for (Index v = 0; v < mesh_.vertex_count; ++v)
      EXPECT_EQ(made.clusters[v], made.clusters[prefix.clusters[v]]) << "vertex " << v;
  }
  EXPECT_NE(all.front().clusters, all.back().clusters);
}

TEST_F(Feature, TheUnifiedMeshIsTheShareOfTheContractionsThatWasAskedFor) {
  for (const double share : {0.5, 0.9, 0.96}) {
    const auto contractions = mesh_.vertex_count - unified({.unified_share = share}).mesh.vertex_count;
    EXPECT_EQ(contractions, static_cast<Index>(share * (mesh_.vertex_count - 200))) << share;
  }
}

TEST_F(Feature, WithAllContractionsUnifiedNoTriangleChanges) {
  EXPECT_EQ(mean_changed(run({.unified_share = 1})), 0);
  EXPECT_GT(mean_changed(run({.unified_share = 0.9})), 0);
}

TEST_F(Feature, MemoryLowersTheChange) {
  EXPECT_LT(mean_changed(run({.memory = true})), 0.8 * mean_changed(run({.memory = false})));
}

TEST_F(Feature, MakesTheSameTwice) {
  const std::vector<Approximation> one = run({}), other = run({});
  for (std::size_t t = 0; t < one.size(); ++t) {
    EXPECT_EQ(one[t].positions, other[t].positions);
    EXPECT_EQ(one[t].triangles, other[t].triangles);
    EXPECT_EQ(one[t].nodes, other[t].nodes);
  }
}

TEST_F(Feature, TheWeightsAndTheLiteralFormulasChangeTheSequence) {
  const std::vector<Index> usual = unified({}).clusters;
  EXPECT_NE(unified({.deformation = 0}).clusters, usual);
  EXPECT_NE(unified({.literal = true}).clusters, usual);
  EXPECT_NE(unified({.feature = 0, .sharp_angle = 170}).clusters, unified({.feature = 1, .sharp_angle = 170}).clusters);
}

TEST_F(Feature, AnotherFrameThanThoseSeenCanFollow) {
  const auto method = find_method("feature")->create({.triangles = 300});
  method->begin(mesh_, std::span(seen_).first(2));
  Approximation made;
  method->frame(frames_[7], made);
  EXPECT_LE(made.triangles.size(), 300u);
  EXPECT_GE(made.triangles.size(), 298u);
}

TEST_F(Feature, AFramesChoicesTakeFewBytesAndFewerWithMemory) {
  std::size_t with = 0, without = 0;
  for (const Approximation& made : run({.memory = true})) with += made.choice_bytes;
  for (const Approximation& made : run({.memory = false})) without += made.choice_bytes;
  EXPECT_GT(with, 0u);
  EXPECT_LT(with, without);
}

// Vertices of the unified mesh are joined by the frame's clusters; the code must give these back.
TEST_F(Feature, SuffixCodeGivesTheClustersBackFrameAfterFrame) {
  const UnifiedMesh prefix = unified({});
  SuffixCode writer(prefix.mesh), reader(prefix.mesh);
  const Index count = prefix.mesh.vertex_count;
  std::vector<Index> clusters(count), read(count);
  for (const Approximation& made : run({})) {
    for (Index node = 0; node < count; ++node) clusters[node] = made.clusters[prefix.vertices[node]];
    reader.decode(writer.encode(clusters), read);
    std::set<std::pair<Index, Index>> pairs;
    for (Index node = 0; node < count; ++node) pairs.insert({clusters[node], read[node]});
    // One to one: as many pairs as there are numbers on either side.
    EXPECT_EQ(pairs.size(), std::set<Index>(clusters.begin(), clusters.end()).size());
    EXPECT_EQ(pairs.size(), std::set<Index>(read.begin(), read.end()).size());
  }
}

TEST_F(Feature, SuffixCodeReadsAnyBytesAsSomeClusters) {
  const UnifiedMesh prefix = unified({});
  std::vector<Index> clusters(prefix.mesh.vertex_count);
  for (unsigned fill = 0; fill < 256; ++fill) {
    SuffixCode reader(prefix.mesh);
    reader.decode(std::vector<std::byte>(fill % 7, static_cast<std::byte>(fill)), clusters);
    for (Index v = 0; v < clusters.size(); ++v) ASSERT_LE(clusters[v], v);
  }
}

TEST(FeatureQuadrics, HoldAnEdgeThatIsSharpInTheFirstFrameAndTheLast) {
  // Two triangles that meet in the edge 0 1: folded to 30 degrees, or open.
  const Mesh mesh{4, {{0, 1, 2}, {1, 0, 3}}};
  const std::vector<Vec3f> sharp{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0.26f}, {0.5, 1, -0.26f}};
  const std::vector<Vec3f> open{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}};
  EXPECT_EQ(FeatureQuadrics(mesh, sharp, sharp, {}).crease_count(), 1u);
  EXPECT_EQ(FeatureQuadrics(mesh, sharp, open, {}).crease_count(), 0u);
  EXPECT_EQ(FeatureQuadrics(mesh, open, open, {}).crease_count(), 0u);
  MethodOptions literal;
  literal.feature.literal = true;
  EXPECT_EQ(FeatureQuadrics(mesh, sharp, sharp, literal).crease_count(), 0u);

  std::vector<Vec3d> positions;
  for (const Vec3f& p : sharp) positions.push_back(static_cast<Vec3d>(p));
  std::vector<Quadric> held(4), plain(4);
  FeatureQuadrics(mesh, sharp, sharp, {}).compute(positions, held);
  FeatureQuadrics(mesh, open, open, {}).compute(positions, plain);
  const Vec3d along{0.5, 0, 0}, into{0, 0.5, 0};
  EXPECT_NEAR(held[0](along), plain[0](along), 1e-9) << "along the edge it slides as before";
  EXPECT_GT(held[0](into), plain[0](into) + 0.1) << "into the surface it does not";
}

TEST(FeatureQuadrics, AsPrintedMultiplyUnweightedPlanesWithTheAreaAround) {
  const Mesh mesh{4, {{0, 1, 2}, {0, 2, 3}}};
  const std::vector<Vec3f> flat{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
  MethodOptions literal;
  literal.feature.literal = true;
  literal.contract.quadrics.point_weight = 1e-9;
  FeatureQuadrics quadrics(mesh, flat, flat, literal);
  std::vector<Vec3d> positions;
  for (const Vec3f& p : flat) positions.push_back(static_cast<Vec3d>(p));
  std::vector<Quadric> out(4);
  quadrics.compute(positions, out);
  EXPECT_NEAR(out[0]({0, 0, 1}), 2 * 2, 1e-6) << "two planes, area 2";
  EXPECT_NEAR(out[1]({2, 0, 1}), 1, 1e-6) << "one plane, area 1";
}

}  // namespace
}  // namespace limber::eval
