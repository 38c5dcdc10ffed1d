// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/swap_validity.h"

#include <gtest/gtest.h>

#include "limber/hierarchy/validate.h"
#include "tests/support/hierarchies.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Random;
using test::Shape;
using Rows = std::vector<std::string>;

bool is_valid(const Mesh& mesh, const Hierarchy& h, Swap swap, Topology topology) {
  const ChildLists clusters(h);
  const LevelGraph graph = test::graph_of(mesh, h, h.level_of(swap.node), topology == Topology::kFree);
  return SwapValidity(h, clusters, topology)(graph, swap.node, swap.parent);
}

// A sheet with clusters drawn as letters; swaps of the vertex in column x of row y.
struct Drawing {
  explicit Drawing(const Rows& r, const std::string& groups = "")
      : rows(r),
        mesh(test::sheet(static_cast<Index>(r[0].size()), static_cast<Index>(r.size())).mesh),
        hierarchy(test::drawn(r, groups)) {}

  Swap swap(Index x, Index y, char to) const {
    return {y * static_cast<Index>(rows[0].size()) + x, test::drawn_node(rows, to)};
  }
  bool allows(Index x, Index y, char to, Topology topology) const {
    return is_valid(mesh, hierarchy, swap(x, y, to), topology);
  }
  bool is_sound(Topology topology) const { return !Validator(mesh, topology)(hierarchy); }
  bool is_sound_after(Index x, Index y, char to, Topology topology) const {
    Hierarchy after = hierarchy;
    apply(after, swap(x, y, to));
    return !Validator(mesh, topology)(after);
  }
  bool has_edge(char p, char q) const { return has_edge(hierarchy, p, q); }
  bool has_edge_after(Index x, Index y, char to, char p, char q) const {
    Hierarchy after = hierarchy;
    apply(after, swap(x, y, to));
    return has_edge(after, p, q);
  }

  Rows rows;
  Mesh mesh;
  Hierarchy hierarchy;

 private:
  bool has_edge(const Hierarchy& h, char p, char q) const {
    const LevelGraph graph = test::graph_of(mesh, h, 1, true);
    const auto around = graph.around(test::drawn_node(rows, p));
    return std::find(around.begin(), around.end(), test::drawn_node(rows, q)) != around.end();
  }
};

constexpr Topology kBoth[] = {Topology::kPreserve, Topology::kFree};

TEST(SwapValidity, AllowsAVertexToWalkOverAStraightBoundary) {  // Figure 3
  const Drawing d({"aaabbb", "aaabbb", "aaabbb", "cccddd", "cccddd", "cccddd"});
  for (const Topology topology : kBoth) {
    ASSERT_TRUE(d.is_sound(topology));
    EXPECT_TRUE(d.allows(2, 1, 'b', topology));
    EXPECT_TRUE(d.allows(3, 1, 'a', topology));
    EXPECT_TRUE(d.allows(2, 0, 'b', topology)) << "along the border too";
  }
}

TEST(SwapValidity, AllowsASwapThatFlipsACoarseEdge) {  // Figure 4
  const Drawing d({"aabb", "aabb", "ccdd", "ccdd"});
  EXPECT_TRUE(d.has_edge('a', 'd') && !d.has_edge('b', 'c'));
  for (const Topology topology : kBoth) {
    ASSERT_TRUE(d.is_sound(topology));
    EXPECT_TRUE(d.allows(1, 1, 'b', topology));
    EXPECT_TRUE(d.is_sound_after(1, 1, 'b', topology));
  }
  EXPECT_TRUE(!d.has_edge_after(1, 1, 'b', 'a', 'd') && d.has_edge_after(1, 1, 'b', 'b', 'c'));
}

TEST(SwapValidity, RefusesAPinchVertex) {  // Figure 5, left
  const Drawing d({"bbbbb", "baaab", "ccccc"});
  for (const Topology topology : kBoth) EXPECT_FALSE(d.allows(2, 1, 'b', topology));
  EXPECT_FALSE(d.is_sound_after(2, 1, 'b', Topology::kFree));
}

TEST(SwapValidity, AllowsTheEndOfTheSameChain) {  // Figure 5, right
  const Drawing d({"bbbbb", "baaab", "ccccc"});
  EXPECT_TRUE(d.allows(1, 1, 'b', Topology::kFree));
  EXPECT_TRUE(d.allows(3, 1, 'b', Topology::kFree));
}

TEST(SwapValidity, RefusesToJoinClustersThatTouchElsewhereIfTheShapeIsPromised) {  // Figure 6
  const Drawing d({"bbbbb", "caabb", "caabb", "cccdd", "cccdd"});
  ASSERT_TRUE(d.has_edge('b', 'c'));
  ASSERT_TRUE(d.is_sound(Topology::kPreserve));
  EXPECT_FALSE(d.allows(2, 2, 'b', Topology::kPreserve));
  EXPECT_FALSE(d.is_sound_after(2, 2, 'b', Topology::kPreserve));
  EXPECT_TRUE(d.allows(2, 2, 'b', Topology::kFree));
}

TEST(SwapValidity, RefusesTheLastVertexOfACluster) {
  const Drawing d({"aaaa", "abca", "aaaa"});
  for (const Topology topology : kBoth) {
    EXPECT_FALSE(d.allows(1, 1, 'a', topology));
    EXPECT_FALSE(d.allows(1, 1, 'c', topology));
  }
}

TEST(SwapValidity, RefusesAClusterThatIsNotBeside) {
  const Drawing d({"aabbcc", "aabbcc", "aabbcc"});
  for (const Topology topology : kBoth) EXPECT_FALSE(d.allows(1, 1, 'c', topology));
}

TEST(SwapValidity, OpensAnAnnulusOnlyWhereTheTopologyIsFree) {
  const Drawing d({"ccccc", "caaac", "cabac", "caaac", "ccccc"});
  EXPECT_FALSE(d.allows(2, 1, 'b', Topology::kPreserve));
  EXPECT_TRUE(d.allows(2, 1, 'b', Topology::kFree));
  EXPECT_TRUE(d.is_sound_after(2, 1, 'b', Topology::kFree));
}

TEST(SwapValidity, RefusesToReachTheBorderASecondTime) {
  // b already stands on the lower border; through the vertex above it it would reach the upper one.
  const Drawing d({"aaacc", "abbcc", "abbcc"});
  ASSERT_TRUE(d.is_sound(Topology::kPreserve));
  EXPECT_FALSE(d.allows(2, 0, 'b', Topology::kPreserve));
  EXPECT_FALSE(d.is_sound_after(2, 0, 'b', Topology::kPreserve));
  EXPECT_TRUE(d.allows(2, 0, 'b', Topology::kFree));
}

TEST(SwapValidity, RefusesToLeaveABorderCornerThatHoldsTwoBorders) {
  // Moving the only vertex of a on the border would let b and c meet there, which they do above a already.
  const Drawing d({"bbbccc", "bbaacc", "bbbacc"});
  EXPECT_FALSE(d.allows(3, 2, 'b', Topology::kPreserve));
}

TEST(SwapValidity, RefusesWhatIsValidOnItsLevelButNotOnTheCoarserOne) {
  // The vertex between p and r joins them; their common cluster on level 2 would fall apart, p and r would not.
  const Rows rows = {"qqqq", "pprr", "ssss"};
  const Drawing alone(rows), grouped(rows, "XYXZ");  // in the order p q r s
  EXPECT_TRUE(alone.allows(1, 1, 'q', Topology::kFree));
  EXPECT_TRUE(alone.is_sound_after(1, 1, 'q', Topology::kFree));
  ASSERT_TRUE(grouped.is_sound(Topology::kFree));
  EXPECT_FALSE(grouped.allows(1, 1, 'q', Topology::kFree));
  EXPECT_FALSE(grouped.is_sound_after(1, 1, 'q', Topology::kFree));
}

TEST(SwapValidity, DoesNotLookBeyondTheFirstClusterThatHoldsBoth) {
  const Rows rows = {"qqqq", "pprr", "ssss"};
  const Drawing grouped(rows, "XXXZ");  // p, q and r are one cluster above: nothing changes there
  EXPECT_TRUE(grouped.allows(1, 1, 'q', Topology::kFree));
}

TEST(SwapValidity, PromisesNothingAroundANonManifoldVertexSoItStays) {
  // Two sheets joined at a vertex.
  Shape both = test::together(test::sheet(4, 4), test::sheet(4, 4), 5);
  for (Triangle& t : both.mesh.triangles)
    for (Index& corner : t)
      if (corner == 16) corner = 15;
  Hierarchy h{{0, 32, 35}, std::vector<Index>(35, kNone)};
  for (Index v = 0; v < 32; ++v) h.parent[v] = v < 8 ? 32 : v < 16 ? 33 : 34;
  h.parent[15] = 34;
  EXPECT_FALSE(is_valid(both.mesh, h, {15, 33}, Topology::kPreserve));
  EXPECT_TRUE(is_valid(both.mesh, h, {15, 33}, Topology::kFree));
}

struct Tally {
  int allowed = 0, refused = 0, refused_but_sound = 0;
};

// Random swaps on all levels; those that are allowed are made. The validator knows nothing of swaps.
void swap_at_random(const Shape& shape, Hierarchy h, Topology topology, int rounds, std::uint64_t seed, Tally& tally) {
  Validator validator(shape.mesh, topology);
  ASSERT_FALSE(validator(h)) << validator(h)->line();
  ChildLists clusters(h);
  SwapValidity is_valid(h, clusters, topology);
  Random random(seed);
  LevelGraphBuilder builder;
  std::vector<LevelGraph> graphs(h.level_count());
  builder.build_finest(shape.mesh, topology == Topology::kFree, graphs[0]);
  for (int round = 0; round < rounds; ++round) {
    const Index level = random.below(h.level_count() - 1);
    for (Index k = 1; k <= level; ++k) builder.build_coarser(h, k, graphs[k - 1], graphs[k]);
    for (int tries = 0; tries < 6; ++tries) {
      const Index node = h.level_begin[level] + random.below(h.level_size(level));
      const auto around = graphs[level].around(node);
      if (around.empty()) continue;
      const Index from = h.parent[node], to = h.parent[around[random.below(static_cast<Index>(around.size()))]];
      if (from == to) continue;
      const bool allowed = is_valid(graphs[level], node, to);
      apply(h, {node, to});
      const auto violation = validator(h);
      if (allowed) {
        ASSERT_FALSE(violation) << "round " << round << ": " << node << " from " << from << " to " << to << ": "
                                << violation->line();
        clusters.move(node, from, to);
        ++tally.allowed;
      } else {
        ++tally.refused;
        tally.refused_but_sound += !violation;
        apply(h, {node, from});
      }
    }
  }
}

// Random deaths of clusters, each followed by a birth, so that no cluster stays empty; those that are allowed are made.
void rebear_at_random(const Shape& shape, Hierarchy h, Topology topology, int rounds, std::uint64_t seed,
                      Tally& tally) {
  Validator validator(shape.mesh, topology);
  ChildLists clusters(h);
  SwapValidity is_valid(h, clusters, topology);
  Random random(seed);
  const auto move = [&](Index node, Index to) {
    clusters.move(node, h.parent[node], to);
    h.parent[node] = to;
  };
  const auto is_last = [&](Index node) {
    return clusters.first_child(h.parent[node]) == node && clusters.next_sibling(node) == kNone;
  };
  for (int round = 0; round < rounds; ++round) {
    const Index level = random.below(h.level_count() - 1);
    const LevelGraph graph = test::graph_of(shape.mesh, h, level, topology == Topology::kFree);
    const auto any = [&] { return h.level_begin[level] + random.below(h.level_size(level)); };
    const Index dying = any();
    const auto around = graph.around(dying);
    if (around.empty() || !is_last(dying)) continue;
    const Index from = h.parent[dying], to = h.parent[around[random.below(static_cast<Index>(around.size()))]];
    if (from == to) continue;
    const Hierarchy before = h;
    const bool may_end = is_valid.may_end(graph, dying, to);
    ++(may_end ? tally.allowed : tally.refused);
    move(dying, to);
    for (int tries = 0; tries < 60; ++tries) {
      const Index founder = any(), old = h.parent[founder];
      if (is_last(founder) || founder == dying) continue;
      // After a death that is not valid any birth will do: where it is valid, the level is as sound as without both.
      const bool may_found = is_valid.may_found(graph, founder);
      if (h.parent[from] != h.parent[old]) move(from, h.parent[old]);
      move(founder, from);
      const auto violation = validator(h);
      if (may_end && may_found) {
        ASSERT_FALSE(violation) << "round " << round << ": " << dying << " to " << to << ", " << founder << " from "
                                << old << ": " << violation->line();
      }
      tally.refused_but_sound += may_end != may_found && !violation;
      if (may_end && may_found) break;
      move(founder, old);
      if (h.parent[from] != before.parent[from]) move(from, before.parent[from]);
    }
    if (clusters.first_child(from) == kNone) {
      move(dying, from);
      ASSERT_EQ(h, before);
    }
  }
}

TEST(SwapValidity, KeepsEveryLevelHomeomorphicThroughRandomDeathsAndBirths) {
  const Shape shapes[] = {test::sphere(2),
                          test::jittered(test::sphere(3), 0.1f, 1),
                          test::torus(7, 11),
                          test::waved(test::sheet(12, 9)),
                          test::waved(test::sheet_with_hole(13, 13)),
                          test::together(test::sphere(2), test::sheet(7, 7), 4)};
  for (const Topology topology : kBoth) {
    Tally tally;
    std::uint64_t seed = 1;
    for (const Shape& shape : shapes)
      for (const double branching : {1.3, 2.0})
        ASSERT_NO_FATAL_FAILURE(
            rebear_at_random(shape, test::built(shape, branching, topology), topology, 400, ++seed, tally))
            << seed;
    EXPECT_GT(tally.allowed, 200);
    if (topology == Topology::kPreserve) {
      EXPECT_GT(tally.refused, 100);
    }
  }
}

TEST(SwapValidity, DoesNotEndTheTipOfATriangleThatHangsOnAPinchedVertex) {
  // Vertex 1 would be left without a triangle, though 2 still has others.
  const Mesh mesh{6, {{0, 1, 2}, {2, 3, 4}, {2, 4, 5}}};
  const Hierarchy h{{0, 6, 12}, {6, 7, 8, 9, 10, 11, kNone, kNone, kNone, kNone, kNone, kNone}};
  const ChildLists clusters(h);
  const LevelGraph graph = test::graph_of(mesh, h, 0, false);
  ASSERT_EQ(graph.star_of(0), StarKind::kBorder);
  ASSERT_EQ(graph.star_of(2), StarKind::kIrregular);
  SwapValidity is_valid(h, clusters, Topology::kPreserve);
  EXPECT_FALSE(is_valid.may_end(graph, 0, 6 + 2));
  EXPECT_FALSE(is_valid.may_end(graph, 0, 6 + 1));
  EXPECT_TRUE(is_valid.may_end(graph, 3, 6 + 4)) << "the other triangle is left there";
}

TEST(SwapValidity, LetsTheLastOfAClusterEndItBesideAnyOtherOnAStraightBoundary) {
  const Drawing drawing({"aaabbb", "aacbbb", "aaabbb"});
  const Index c = drawing.swap(2, 1, 'a').node;
  const ChildLists clusters(drawing.hierarchy);
  const LevelGraph graph = test::graph_of(drawing.mesh, drawing.hierarchy, 0, false);
  SwapValidity is_valid(drawing.hierarchy, clusters, Topology::kFree);
  EXPECT_FALSE(is_valid(graph, c, test::drawn_node(drawing.rows, 'a'))) << "as a swap it leaves an empty cluster";
  EXPECT_TRUE(is_valid.may_end(graph, c, test::drawn_node(drawing.rows, 'a')));
  EXPECT_TRUE(is_valid.may_end(graph, c, test::drawn_node(drawing.rows, 'b')));
}

TEST(SwapValidity, RefusesToFoundAClusterThatWouldHaveOnlyTwoNeighbours) {
  // Inside a cluster: a corner of the level needs three.
  const Drawing drawing({"aaaab", "aaaab", "aaaab", "aaacc"});
  const ChildLists clusters(drawing.hierarchy);
  const LevelGraph graph = test::graph_of(drawing.mesh, drawing.hierarchy, 0, false);
  SwapValidity is_valid(drawing.hierarchy, clusters, Topology::kPreserve);
  EXPECT_FALSE(is_valid.may_found(graph, drawing.swap(1, 1, 'b').node)) << "all around it is a";
  EXPECT_FALSE(is_valid.may_found(graph, drawing.swap(3, 1, 'b').node)) << "between two";
  EXPECT_TRUE(is_valid.may_found(graph, drawing.swap(3, 2, 'b').node)) << "where three meet";
  EXPECT_TRUE(is_valid.may_found(graph, drawing.swap(3, 0, 'b').node)) << "between two on the border";
}

TEST(SwapValidity, KeepsEveryLevelHomeomorphicThroughThousandsOfRandomSwaps) {
  const Shape shapes[] = {test::sphere(2),
                          test::jittered(test::sphere(3), 0.1f, 1),
                          test::torus(7, 11),
                          test::torus(5, 16),
                          test::waved(test::sheet(12, 9)),
                          test::waved(test::sheet_with_hole(13, 13)),
                          test::waved(test::sheet(16, 12, [](Index x, Index y) { return x % 5 != 2 || y % 5 != 2; })),
                          test::together(test::sphere(2), test::sheet(7, 7), 4)};
  Tally tally;
  std::uint64_t seed = 1;
  for (const Shape& shape : shapes) {
    for (const double branching : {2.5, 5.0}) {
      const Hierarchy h = test::built(shape, branching, Topology::kPreserve);
      ASSERT_GE(h.level_count(), 2u);
      ASSERT_NO_FATAL_FAILURE(swap_at_random(shape, h, Topology::kPreserve, 120, ++seed, tally)) << seed;
    }
  }
  EXPECT_GT(tally.allowed, 1000);
  EXPECT_GT(tally.refused, 1000);
  // The rule is not only safe: almost all that it refuses would break something.
  EXPECT_LT(tally.refused_but_sound, tally.refused / 20) << tally.refused;
}

TEST(SwapValidity, IsExactWhereTheTopologyIsFree) {
  const Shape shapes[] = {test::sphere(2), test::torus(5, 16), test::waved(test::sheet_with_hole(13, 13)),
                          test::together(test::sphere(2), test::sheet(7, 7), 4)};
  Tally tally;
  std::uint64_t seed = 1;
  for (const Shape& shape : shapes) {
    for (const double branching : {2.5, 5.0}) {
      const Hierarchy h = test::built(shape, branching, Topology::kFree);
      ASSERT_NO_FATAL_FAILURE(swap_at_random(shape, h, Topology::kFree, 150, ++seed, tally)) << seed;
    }
  }
  EXPECT_GT(tally.allowed, 1000);
  EXPECT_GT(tally.refused, 300);
  EXPECT_EQ(tally.refused_but_sound, 0);
}

TEST(SwapValidity, KeepsItsPromiseOnMeshesWithNonManifoldParts) {
  Random random(9);
  Tally tally;
  for (int round = 0; round < 20; ++round) {
    Shape shape = test::together(test::waved(test::sheet(9, 9)), test::torus(7, 9), 3);
    shape = test::together(shape, test::sphere(2), 7);
    for (int glue = 0; glue < 3; ++glue) {
      const Index from = random.below(shape.mesh.vertex_count), to = random.below(shape.mesh.vertex_count);
      for (Triangle& t : shape.mesh.triangles)
        for (Index& corner : t)
          if (corner == from) corner = to;
    }
    shape.mesh.triangles.push_back({random.below(81), random.below(81), random.below(81)});
    for (const Topology topology : kBoth) {
      BuildOptions options;
      options.level_sizes = {shape.mesh.vertex_count / 3, shape.mesh.vertex_count / 6};
      options.contract.topology = topology;
      const std::span<const Vec3f> frames[] = {shape.positions};
      const Hierarchy h = build_hierarchy(shape.mesh, frames, options);
      ASSERT_NO_FATAL_FAILURE(swap_at_random(shape, h, topology, 40, static_cast<std::uint64_t>(round), tally))
          << round;
    }
  }
  EXPECT_GT(tally.allowed, 1000);
}

}  // namespace
}  // namespace limber
