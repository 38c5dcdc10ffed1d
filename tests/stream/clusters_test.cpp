// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/clusters.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "tests/stream/sample_clip.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

// 0 1 | 2 3 | 4 5, a strip of vertices above and below each other; clusters 6, 7, 8; all of them in 9.
class ClustersOfAStrip : public ::testing::Test {
 protected:
  ClustersOfAStrip() {
    for (Index node = 0; node < 6; ++node) clusters_.place({node, 6 + node / 2});
    for (Index node = 6; node < 9; ++node) clusters_.place({node, 9});
  }

  std::vector<Index> candidates(Index level, Index node) {
    std::vector<Index> parents;
    for (const Candidate& candidate : clusters_.candidates(level, node, own_)) parents.push_back(candidate.parent);
    return parents;
  }

  const Mesh mesh_{6, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}};
  const std::vector<Index> level_begin_{0, 6, 9, 11};
  const IndexLists neighbors_ = neighbors(mesh_, incident_triangles(mesh_));
  Clusters clusters_{level_begin_, neighbors_};
  std::uint32_t own_ = 0;
};

TEST_F(ClustersOfAStrip, CandidatesAreTheClustersBesideAVertex) {
  EXPECT_EQ(candidates(0, 0), (std::vector<Index>{7}));
  EXPECT_EQ(own_, 1u);
  EXPECT_EQ(candidates(0, 3), (std::vector<Index>{8, 6}));  // two edges to 8, one to 6
}

TEST_F(ClustersOfAStrip, CandidatesFollowASwap) {
  clusters_.apply({2, 6});
  EXPECT_EQ(candidates(0, 2), (std::vector<Index>{7, 8}));
  EXPECT_EQ(own_, 2u);
  EXPECT_EQ(clusters_.changed()[0], 1);
  EXPECT_EQ(clusters_.changed()[1], 1);
  EXPECT_EQ(clusters_.changed()[2], 0);
  clusters_.forget_changes();
  EXPECT_EQ(clusters_.changed()[0], 0);
}

TEST_F(ClustersOfAStrip, CandidatesOfACoarserNodeComeFromItsVertices) {
  clusters_.apply({8, 10});
  EXPECT_EQ(candidates(1, 7), (std::vector<Index>{10}));
  EXPECT_EQ(own_, 3u);
  EXPECT_EQ(candidates(1, 6), (std::vector<Index>{}));
}

TEST_F(ClustersOfAStrip, AClusterThatAllHaveLeftHasNoChildren) {
  clusters_.apply({0, 7});
  EXPECT_TRUE(clusters_.has_children(6));
  clusters_.apply({1, 7});
  EXPECT_FALSE(clusters_.has_children(6));
  EXPECT_EQ(candidates(1, 6), (std::vector<Index>{}));
}

// By the definition (docs/format.md): edges from vertices below a node to those of other clusters of its level.
TEST(Clusters, CandidatesAreThoseThatTheEdgesLeadToOnEveryLevel) {
  const test::Surface torus = test::torus(16, 24);
  const FrameState state = test::patch_state(torus, {384, 120, 40, 15, 6, 2});
  const std::vector<Index>&level_begin = state.hierarchy.level_begin, &parent = state.hierarchy.parent;
  const IndexLists neighbors = limber::neighbors(torus.mesh, incident_triangles(torus.mesh));
  Clusters clusters(level_begin, neighbors);
  for (Index node = 0; node < level_begin[5]; ++node) clusters.place({node, parent[node]});
  const auto above = [&](Index vertex, Index level) {
    while (level-- > 0) vertex = parent[vertex];
    return vertex;
  };
  const auto children = [&](Index node) {
    std::vector<Index> found;
    for (Index n = level_begin[5]; n-- > 0;)
      if (parent[n] == node) found.push_back(n);  // the one that came last first
    return found;
  };
  const auto below = [&](Index level, Index node) {
    std::vector<Index> nodes{node};
    for (; level > 0; --level) {
      std::vector<Index> next;
      for (const Index n : nodes) {
        auto all = children(n);
        if (nodes.size() >= 4) all.resize(1);
        next.insert(next.end(), all.begin(), all.end());
      }
      if (next.size() > 8) next.resize(8);
      nodes = next;
    }
    return nodes;
  };
  bool some_are_left_out = false;
  for (Index level = 0; level < 5; ++level) {
    for (Index node = level_begin[level]; node < level_begin[level + 1]; ++node) {
      std::vector<std::uint32_t> counts(level_begin.back(), 0);
      Index edge_count = 0;
      for (const Index v : below(level, node)) {
        ASSERT_EQ(above(v, level), node);
        for (const Index neighbor : neighbors[v])
          if (edge_count++ < 64 && above(neighbor, level) != node) ++counts[above(neighbor, level + 1)];
      }
      some_are_left_out = some_are_left_out || below(level, node).size() == 8;
      std::uint32_t own = 0;
      const auto candidates = clusters.candidates(level, node, own);
      EXPECT_EQ(own, counts[parent[node]]);
      counts[parent[node]] = 0;
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        EXPECT_EQ(candidates[i].edge_count, counts[candidates[i].parent]);
        counts[candidates[i].parent] = 0;
        if (i == 0) continue;
        EXPECT_GE(candidates[i - 1].edge_count, candidates[i].edge_count);
        if (candidates[i - 1].edge_count == candidates[i].edge_count) {
          EXPECT_LT(candidates[i - 1].parent, candidates[i].parent);
        }
      }
      EXPECT_EQ(std::count(counts.begin(), counts.end(), 0u), static_cast<std::ptrdiff_t>(counts.size()));
    }
  }
  EXPECT_TRUE(some_are_left_out);
}

TEST(Clusters, LookAtTheFirstEdgesOfAVertexThatHasMany) {
  constexpr Index kRim = 100;
  Mesh fan{kRim + 1, {}};
  for (Index v = 1; v < kRim; ++v) fan.triangles.push_back({0, v, v + 1});
  const std::vector<Index> level_begin{0, kRim + 1, 2 * (kRim + 1)};
  const IndexLists neighbors = limber::neighbors(fan, incident_triangles(fan));
  Clusters clusters(level_begin, neighbors);
  for (Index v = 0; v <= kRim; ++v) clusters.place({v, kRim + 1 + v});
  std::uint32_t own = 0;
  const auto candidates = clusters.candidates(0, 0, own);
  ASSERT_EQ(candidates.size(), 64u);
  EXPECT_EQ(candidates.front().parent, kRim + 2);
  EXPECT_EQ(candidates.back().parent, kRim + 65);
}

}  // namespace
}  // namespace limber
