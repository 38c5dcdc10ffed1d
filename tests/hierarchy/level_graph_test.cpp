// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/level_graph.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "limber/contract/edges.h"
#include "tests/support/hierarchies.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Random;

LevelGraph finest(const Mesh& mesh, bool keep_edges = false) {
  LevelGraph graph;
  LevelGraphBuilder().build_finest(mesh, keep_edges, graph);
  return graph;
}

std::vector<Index> around(const LevelGraph& graph, Index node) {
  const auto span = graph.around(node);
  return {span.begin(), span.end()};
}

// Everything that a graph says, against sets made of the triangles and edges that it should hold.
void expect_is(const LevelGraph& graph, Index first, Index size, const std::vector<Triangle>& triangles,
               const std::set<std::pair<Index, Index>>& lone_edges) {
  ASSERT_EQ(graph.first_node, first);
  ASSERT_EQ(graph.size(), size);
  ASSERT_EQ(graph.begin.size(), size + 1);
  ASSERT_EQ(graph.triangles, triangles);
  std::vector<std::set<Index>> neighbours(size), by_triangles(size);
  std::vector<std::vector<std::pair<Index, Index>>> across(size);
  for (const auto& [a, b, c] : triangles)
    for (const auto& [p, q, r] : {Triangle{a, b, c}, {b, c, a}, {c, a, b}}) {
      by_triangles[p - first].insert({q, r});
      across[p - first].push_back({q, r});
    }
  neighbours = by_triangles;
  for (const auto& [a, b] : lone_edges) neighbours[a - first].insert(b), neighbours[b - first].insert(a);
  for (Index i = 0; i < size; ++i) {
    const std::vector<Index> listed = around(graph, first + i);
    ASSERT_EQ(std::set<Index>(listed.begin(), listed.end()), neighbours[i]) << i;
    ASSERT_EQ(listed.size(), neighbours[i].size()) << "a neighbour is listed twice";
    const bool fan = !across[i].empty() && neighbours[i] == by_triangles[i] && test::is_fan(across[i]);
    const bool closed = fan && across[i].size() == listed.size();
    ASSERT_EQ(graph.star_of(first + i), !fan     ? StarKind::kIrregular
                                        : closed ? StarKind::kClosed
                                                 : StarKind::kBorder)
        << i;
    if (!fan) continue;
    const bool is_led = std::ranges::all_of(across[i], [&](const auto& side) {
      const auto at = std::ranges::find(listed, side.first);
      return side.second == (at + 1 == listed.end() ? listed.front() : at[1]);
    });
    std::set<Index> begins, ends;
    for (const auto& [q, r] : across[i]) begins.insert(q), ends.insert(r);
    const bool faces_alike = begins.size() == across[i].size() && ends.size() == across[i].size();
    ASSERT_TRUE(is_led || !faces_alike) << i;
    std::set<std::pair<Index, Index>> sides;
    for (const auto& [q, r] : across[i]) sides.insert(std::minmax(q, r));
    for (std::size_t k = 0; k + 1 < listed.size(); ++k)
      ASSERT_TRUE(sides.contains(std::minmax(listed[k], listed[k + 1]))) << i;
    ASSERT_EQ(closed, listed.size() > 2 && sides.contains(std::minmax(listed.front(), listed.back()))) << i;
  }
}

TEST(LevelGraph, PutsTheNeighboursOfAClosedStarInCyclicOrder) {
  const LevelGraph graph = finest(test::octahedron().mesh);
  for (Index v = 0; v < 6; ++v) {
    EXPECT_EQ(graph.star_of(v), StarKind::kClosed);
    const std::vector<Index> ring = around(graph, v);
    ASSERT_EQ(ring.size(), 4u);
    EXPECT_EQ(ring[0] / 2, ring[2] / 2) << "opposite corners are 2 i and 2 i + 1";
    EXPECT_EQ(ring[1] / 2, ring[3] / 2);
  }
}

TEST(LevelGraph, PutsTheNeighboursOnABorderFromEndToEnd) {
  const LevelGraph graph = finest({5, {{0, 3, 4}, {0, 1, 2}, {0, 2, 3}}});
  EXPECT_EQ(graph.star_of(0), StarKind::kBorder);
  const std::vector<Index> fan = around(graph, 0), reversed(fan.rbegin(), fan.rend());
  const std::vector<Index> expected = {1, 2, 3, 4};
  EXPECT_TRUE(fan == expected || reversed == expected);
  EXPECT_EQ(graph.star_of(1), StarKind::kBorder);
}

TEST(LevelGraph, CallsIrregularWhatIsNoSingleFan) {
  EXPECT_EQ(finest({1, {}}).star_of(0), StarKind::kIrregular);                                 // isolated
  EXPECT_EQ(finest({5, {{0, 1, 2}, {0, 3, 4}}}).star_of(0), StarKind::kIrregular);             // bow-tie
  EXPECT_EQ(finest({5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}}).star_of(0), StarKind::kIrregular);  // three pages
  EXPECT_EQ(finest({3, {{0, 1, 2}, {0, 2, 1}}}).star_of(0), StarKind::kIrregular);             // back to back
  EXPECT_EQ(finest({3, {{0, 1, 2}, {0, 1, 2}}}).star_of(0), StarKind::kIrregular);             // repeated
  EXPECT_EQ(finest({6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}}}).star_of(0), StarKind::kIrregular);  // fan and fin
}

TEST(LevelGraph, LeavesOutDegenerateTriangles) {
  const LevelGraph graph = finest({4, {{0, 1, 1}, {0, 1, 2}, {3, 3, 3}}}, true);
  EXPECT_EQ(graph.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(graph.edges.size(), 3u);
  EXPECT_TRUE(around(graph, 3).empty());
}

TEST(LevelGraph, KeepsANeckThatIsOnlyAnEdgeIfAsked) {
  // A bar of one triangle between two larger ones, its foot in the left one.
  const Mesh mesh{7, {{0, 1, 2}, {2, 3, 6}, {3, 4, 5}}};
  const Hierarchy h{{0, 7, 10}, {7, 7, 8, 9, 9, 9, 8, kNone, kNone, kNone}};
  const LevelGraph with = test::graph_of(mesh, h, 1, true), without = test::graph_of(mesh, h, 1, false);
  EXPECT_TRUE(with.triangles.empty());
  EXPECT_EQ(with.edges, (std::vector<std::array<Index, 2>>{{7, 8}, {8, 9}}));
  EXPECT_EQ(around(with, 8), (std::vector<Index>{7, 9}));
  EXPECT_EQ(with.star_of(8), StarKind::kIrregular);
  EXPECT_TRUE(around(without, 8).empty());
}

TEST(LevelGraph, IsWhatSetsOfTrianglesSayOnRandomMeshesAndHierarchies) {
  Random random(1);
  LevelGraphBuilder builder;  // the same for all: nothing of one may reach the next
  LevelGraph graph, coarser;
  for (int round = 0; round < 400; ++round) {
    Mesh mesh;
    switch (round % 4) {
      case 0:
        mesh = test::sheet_with_hole(7, 7).mesh;
        break;
      case 1:
        mesh = test::torus(4, 6).mesh;
        break;
      default:
        mesh.vertex_count = 1 + random.below(20);
        for (Index t = random.below(40); t > 0; --t)
          mesh.triangles.push_back(
              {random.below(mesh.vertex_count), random.below(mesh.vertex_count), random.below(mesh.vertex_count)});
    }
    Hierarchy h{{0, mesh.vertex_count}, {}};
    for (int level = 0; level < 2; ++level) {
      const Index size = 1 + random.below(h.level_size(h.level_count() - 1));
      const Index first = h.level_begin.back();
      for (Index node = static_cast<Index>(h.parent.size()); node < first; ++node)
        h.parent.push_back(first + random.below(size));
      h.level_begin.push_back(first + size);
    }
    h.parent.resize(h.node_count(), kNone);

    const bool keep_edges = random.below(2) == 0;
    builder.build_finest(mesh, keep_edges, graph);
    std::vector<Triangle> triangles;
    for (const Triangle& t : mesh.triangles)
      if (!is_degenerate(t)) triangles.push_back(t);
    std::set<std::pair<Index, Index>> edges;
    if (keep_edges)
      for (const auto& [a, b] : find_edges(mesh).ends) edges.insert({a, b});
    ASSERT_NO_FATAL_FAILURE(expect_is(graph, 0, mesh.vertex_count, triangles, edges)) << round;
    for (Index level = 1; level < 3; ++level) {
      builder.build_coarser(h, level, graph, coarser);
      std::swap(graph, coarser);
      std::vector<Triangle> images;
      for (const Triangle& t : test::mapped(triangles, h.parent))
        if (!is_degenerate(t)) images.push_back(t);
      triangles = images;
      std::set<std::pair<Index, Index>> edge_images;
      for (const auto& [a, b] : edges)
        if (h.parent[a] != h.parent[b]) edge_images.insert(std::minmax(h.parent[a], h.parent[b]));
      edges = edge_images;
      ASSERT_NO_FATAL_FAILURE(expect_is(graph, h.level_begin[level], h.level_size(level), triangles, edges)) << round;
    }
  }
}

}  // namespace
}  // namespace limber
