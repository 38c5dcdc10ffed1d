// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "eval/methods/method.h"
#include "eval/methods/quadric_error.h"
#include "eval/methods/t_dag_code.h"
#include "eval/methods/t_dag_forest.h"
#include "tests/eval/gallop.h"

namespace limber::eval {
namespace {

using Merges = std::vector<FeatureContraction::Merge>;

class TDag : public Gallop {
 protected:
  static std::vector<Approximation> run(const MethodOptions& options) { return run(options, frames_); }
  static std::vector<Approximation> run(const MethodOptions& options, const std::vector<std::vector<Vec3f>>& frames) {
    const std::span<const Vec3f> seen[] = {frames[0]};
    return Gallop::run("t-dag", options, seen, frames);
  }

  static double quadric_error(const std::vector<Approximation>& all) {
    QuadricError error(mesh_, {});
    double sum = 0;
    for (std::size_t t = 0; t < all.size(); ++t) sum += error.measure(frames_[t], all[t].clusters);
    return sum;
  }

  // The hierarchy that contraction makes of a frame.
  static Forest forest(std::size_t t, Index vertices) {
    VertexQuadrics quadrics(mesh_, QuadricOptions{});
    const Normalization normalize = normalization(frames_[t]);
    FrameData data{1, std::vector<Quadric>(mesh_.vertex_count), {}};
    std::vector<Vec3d> unit;
    for (const Vec3f& p : frames_[t]) {
      unit.push_back(normalize.to_unit(p));
      data.positions.push_back(static_cast<Vec3f>(unit.back()));
    }
    quadrics.compute(unit, data.quadrics);
    class Plain final : public EdgeFactor {
      double factor(Surface&, std::span<const Vec3f>, Index) override { return 1; }
    } plain;
    FeatureContraction contraction(Surface(mesh_), std::move(data), {}, 0, plain);
    contraction.contract_to(vertices, 0);
    return Forest(mesh_.vertex_count, contraction.merges());
  }
};

// How many nodes of one hierarchy the other has too.
Index common_nodes(const Forest& one, const Forest& other) {
  std::vector<std::set<Index>> sets(one.node_count());
  Index count = 0;
  for (Index node = 0; node < one.node_count(); ++node) {
    if (node < one.vertex_count()) sets[node] = {node};
    if (one.parent(node) != kNone) sets[one.parent(node)].insert(sets[node].begin(), sets[node].end());
    auto at = sets[node].begin();
    Forest::Footprint footprint = other.footprint(*at);
    while (++at != sets[node].end()) footprint = Forest::join(footprint, other.footprint(*at));
    count += other.is_node(footprint);
  }
  return count;
}

TEST_F(TDag, HasTheSizeAskedForInEveryFrame) {
  for (const Approximation& made : run({.vertices = 200})) EXPECT_EQ(made.positions.size(), 200u);
  for (const Approximation& made : run({.triangles = 300})) {
    EXPECT_LE(made.triangles.size(), 300u);
    EXPECT_GE(made.triangles.size(), 298u);
  }
}

TEST_F(TDag, NamesEveryClusterAfterAVertexOfIt) {
  for (const Approximation& made : run({.vertices = 200})) {
    std::set<Index> names(made.clusters.begin(), made.clusters.end());
    EXPECT_EQ(names.size(), 200u);
    for (const Index name : names) EXPECT_EQ(made.clusters[name], name);
    EXPECT_EQ(names, std::set<Index>(made.nodes.begin(), made.nodes.end()));
  }
}

TEST_F(TDag, ANodeThatLivesOnKeepsItsName) {
  const std::vector<Approximation> all = run({.vertices = 200});
  std::size_t kept = 0;
  for (std::size_t t = 1; t < all.size(); ++t) {
    std::vector<std::set<Index>> before(mesh_.vertex_count), now(mesh_.vertex_count);
    for (Index v = 0; v < mesh_.vertex_count; ++v) {
      before[all[t - 1].clusters[v]].insert(v);
      now[all[t].clusters[v]].insert(v);
    }
    for (const std::set<Index>& cluster : before) {
      if (cluster.empty()) continue;
      const Index name = all[t].clusters[*cluster.begin()];
      if (now[name] != cluster) continue;
      EXPECT_EQ(name, all[t - 1].clusters[*cluster.begin()]);
      ++kept;
    }
  }
  EXPECT_GT(kept, 200u);
}

TEST_F(TDag, ARepeatedFrameAddsNothing) {
  const std::vector<std::vector<Vec3f>> frames(5, frames_[3]);
  const std::vector<Approximation> all = run({.vertices = 200}, frames);
  EXPECT_GT(all[0].choice_bytes, 100u);
  for (std::size_t t = 1; t < all.size(); ++t) {
    EXPECT_EQ(all[t].triangles, all[0].triangles);
    EXPECT_EQ(all[t].nodes, all[0].nodes);
    EXPECT_LE(all[t].choice_bytes, 12u);
  }
}

TEST_F(TDag, HistoryCostsErrorAndSparesChangeAndBytes) {
  const std::vector<Approximation> with = run({.vertices = 200}), without = run({.vertices = 200, .history = 1});
  EXPECT_LT(mean_changed(with), 0.7 * mean_changed(without));
  EXPECT_GT(quadric_error(with), quadric_error(without));
  EXPECT_LT(quadric_error(with), 1.1 * quadric_error(without));
  std::size_t bytes_with = 0, bytes_without = 0;
  for (const Approximation& made : with) bytes_with += made.choice_bytes;
  for (const Approximation& made : without) bytes_without += made.choice_bytes;
  EXPECT_LT(bytes_with, 0.8 * static_cast<double>(bytes_without));
}

TEST_F(TDag, WithoutHistoryEveryFrameHasTheErrorOfDirect) {
  const auto direct = find_method("direct")->create({.vertices = 200});
  const std::span<const Vec3f> seen[] = {frames_[0]};
  direct->begin(mesh_, seen);
  std::vector<Approximation> all(frames_.size());
  for (std::size_t t = 0; t < all.size(); ++t) direct->frame(frames_[t], all[t]);
  EXPECT_NEAR(quadric_error(run({.vertices = 200, .history = 1})) / quadric_error(all), 1, 0.01);
}

TEST_F(TDag, MakesTheSameTwice) {
  const std::vector<Approximation> one = run({.vertices = 200}), other = run({.vertices = 200});
  for (std::size_t t = 0; t < one.size(); ++t) {
    EXPECT_EQ(one[t].positions, other[t].positions);
    EXPECT_EQ(one[t].triangles, other[t].triangles);
    EXPECT_EQ(one[t].nodes, other[t].nodes);
    EXPECT_EQ(one[t].choice_bytes, other[t].choice_bytes);
  }
}

TEST_F(TDag, TheCodeGivesTheHierarchiesBackFrameAfterFrame) {
  TDagCode writer(mesh_), reader(mesh_);
  for (std::size_t t = 0; t < frames_.size(); ++t) {
    // Of another size in each frame, so that more nodes begin than end, or fewer.
    const Forest written = forest(t, static_cast<Index>(100 + 50 * (t % 3)));
    reader.decode(writer.encode(written));
    const Forest& read = reader.living();
    ASSERT_EQ(read.node_count(), written.node_count());
    EXPECT_EQ(common_nodes(read, written), written.node_count());
    for (Index node = 0; node < read.node_count(); ++node) ASSERT_EQ(read.parent(node), writer.living().parent(node));
    EXPECT_EQ(reader.born(), writer.born());
    EXPECT_EQ(reader.ended(), writer.ended());
    if (t == 0) {
      EXPECT_EQ(writer.ended(), 0u);
      EXPECT_EQ(writer.born(), mesh_.vertex_count - 100);
    }
  }
}

TEST_F(TDag, TheCodeTakesNothingForAFrameThatRepeats) {
  TDagCode writer(mesh_);
  const Forest same = forest(2, 100);
  writer.encode(same);
  for (int i = 0; i < 3; ++i) {
    EXPECT_LE(writer.encode(same).size(), 12u);
    EXPECT_EQ(writer.born(), 0u);
    EXPECT_EQ(writer.ended(), 0u);
  }
}

TEST_F(TDag, TheCodeReadsAnyBytesAsSomeHierarchy) {
  TDagCode writer(mesh_);
  const std::vector<std::byte> first = writer.encode(forest(0, 100)), second = writer.encode(forest(1, 100));
  for (std::size_t i = 0; i < second.size(); i += 40) {
    for (const bool cut : {false, true}) {
      std::vector<std::byte> bytes = second;
      if (cut)
        bytes.resize(i);
      else
        bytes[i] ^= std::byte{0x55};
      TDagCode reader(mesh_);
      reader.decode(first);
      reader.decode(bytes);
      const Forest& read = reader.living();
      ASSERT_LT(read.node_count(), 2 * mesh_.vertex_count);
      for (Index node = 0; node < read.node_count(); ++node) ASSERT_GT(read.parent(node), node);
    }
  }
}

TEST(Forest, KnowsItsNodesAndNoOtherSets) {
  // ((0 1) 2), (3 4), 5
  const Forest forest(6, Merges{{0, 1}, {3, 4}, {2, 0}});
  ASSERT_EQ(forest.node_count(), 9u);
  const std::set<std::set<Index>> nodes{{0}, {1}, {2}, {3}, {4}, {5}, {0, 1}, {3, 4}, {0, 1, 2}};
  for (unsigned bits = 1; bits < 64; ++bits) {
    std::set<Index> vertices;
    Forest::Footprint footprint{kNone, 0, 0};
    for (Index v = 0; v < 6; ++v) {
      if ((bits >> v & 1) == 0) continue;
      vertices.insert(v);
      footprint = Forest::join(footprint, forest.footprint(v));
    }
    EXPECT_EQ(forest.is_node(footprint), nodes.contains(vertices)) << bits;
  }
}

}  // namespace
}  // namespace limber::eval
