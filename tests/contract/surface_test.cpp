// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/surface.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Random;
using test::Shape;

// A surface, and beside it the same contractions as a map of vertices that knows nothing of lists.
struct Checked {
  explicit Checked(Mesh m) : mesh(std::move(m)), surface(mesh), image(mesh.vertex_count) {
    for (Index v = 0; v < mesh.vertex_count; ++v) image[v] = v;
    for (const Triangle& t : mesh.triangles) {
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      finest_edges.insert({std::minmax(t[0], t[1]), std::minmax(t[1], t[2]), std::minmax(t[2], t[0])});
    }
  }

  Index edge(Index u, Index v) {
    Index found = kNone;
    surface.for_each_edge(u, [&](Index e, Index other) {
      if (other == v) found = e;
    });
    return found;
  }
  void contract(Index e) {
    const auto [stays, goes] = surface.ends(e);
    surface.contract(e);
    for (Index& i : image)
      if (i == goes) i = stays;
  }
  std::vector<Triangle> triangles() const { return test::mapped(mesh.triangles, image); }
  std::vector<Index> living_edges() const {
    std::vector<Index> living;
    for (Index e = 0; e < surface.edge_count(); ++e)
      if (surface.is_alive(e)) living.push_back(e);
    return living;
  }

  // The lists of the surface hold what the map says, each thing once.
  void expect_consistent() {
    std::vector<std::multiset<Index>> triangles_of(mesh.vertex_count);
    const std::vector<Triangle> now = triangles();
    for (Index t = 0; t < now.size(); ++t) {
      const auto& [a, b, c] = now[t];
      if (a == b || b == c || c == a) continue;
      ASSERT_EQ(surface.triangle(t), now[t]);
      for (const Index corner : now[t]) triangles_of[corner].insert(t);
    }
    std::vector<std::multiset<Index>> neighbours(mesh.vertex_count);
    std::set<std::pair<Index, Index>> edges;
    for (const auto& [a, b] : finest_edges)
      if (image[a] != image[b]) edges.insert(std::minmax(image[a], image[b]));
    for (const auto& [a, b] : edges) neighbours[a].insert(b), neighbours[b].insert(a);
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      std::multiset<Index> listed_triangles, listed_neighbours;
      surface.for_each_triangle(v, [&](Index t) { listed_triangles.insert(t); });
      surface.for_each_edge(v, [&](Index e, Index other) {
        listed_neighbours.insert(other);
        ASSERT_TRUE(surface.is_alive(e));
        ASSERT_TRUE((surface.ends(e) == std::array{v, other} || surface.ends(e) == std::array{other, v}));
      });
      ASSERT_EQ(listed_triangles, triangles_of[v]) << v;
      ASSERT_EQ(listed_neighbours, neighbours[v]) << v;
    }
  }

  Mesh mesh;
  Surface surface;
  std::vector<Index> image;
  std::set<std::pair<Index, Index>> finest_edges;
};

TEST(Surface, CountsOnlyVerticesThatHaveAnEdge) {
  EXPECT_EQ(Surface({}).vertex_count(), 0u);
  EXPECT_EQ(Surface({7, {{0, 1, 2}, {3, 3, 4}}}).vertex_count(), 3u);
  EXPECT_EQ(Surface({7, {{0, 1, 2}, {3, 3, 4}}}).edge_count(), 3u);
}

TEST(Surface, LosesTwoTrianglesAndAVertexWithAnEdgeInside) {
  Checked checked(test::sheet(4, 4).mesh);
  const Index e = checked.edge(5, 10);
  ASSERT_TRUE(checked.surface.keeps_topology(e));
  checked.contract(e);
  EXPECT_FALSE(checked.surface.is_alive(e));
  EXPECT_EQ(checked.surface.vertex_count(), 15u);
  const test::Invariants after = test::invariants_of(checked.triangles());
  EXPECT_EQ(after.vertex_count, 15);
  EXPECT_TRUE(test::same_shape(after, test::invariants_of(checked.mesh.triangles)));
  EXPECT_EQ(checked.living_edges().size(), static_cast<std::size_t>(checked.surface.edge_count()) - 3);
  checked.expect_consistent();
}

TEST(Surface, LosesOneTriangleWithAnEdgeOnTheBorder) {
  Checked checked(test::sheet(3, 3).mesh);
  const Index e = checked.edge(1, 2);
  ASSERT_TRUE(checked.surface.keeps_topology(e));
  checked.contract(e);
  EXPECT_EQ(checked.living_edges().size(), static_cast<std::size_t>(checked.surface.edge_count()) - 2);
  EXPECT_TRUE(test::same_shape(test::invariants_of(checked.triangles()), test::invariants_of(checked.mesh.triangles)));
  checked.expect_consistent();
}

TEST(Surface, NamesTheEdgesThatAContractionEnds) {
  Checked checked(test::sheet(4, 4).mesh);
  std::vector<Index> living = checked.living_edges();
  for (const auto& [from, to] : {std::pair{5u, 10u}, {0u, 1u}, {2u, 3u}}) {
    const Index contracted = checked.edge(from, to);
    const std::span<const Index> gone = checked.surface.contract(contracted);
    EXPECT_EQ(std::count(gone.begin(), gone.end(), contracted), 1);
    for (const Index e : gone) EXPECT_EQ(std::erase(living, e), 1u) << e;
    EXPECT_EQ(living, checked.living_edges());
  }
}

TEST(Surface, RefusesAnEdgeBetweenTwoBorders) {
  // Two squares beside each other: the edge in the middle joins border to border.
  Checked checked(test::sheet(3, 2).mesh);
  EXPECT_FALSE(checked.surface.keeps_topology(checked.edge(1, 4)));
}

TEST(Surface, RefusesEveryEdgeOfATriangleAndOfATetrahedron) {
  for (Mesh mesh : {Mesh{3, {{0, 1, 2}}}, test::tetrahedron().mesh}) {
    Checked checked(mesh);
    for (Index e = 0; e < checked.surface.edge_count(); ++e) EXPECT_FALSE(checked.surface.keeps_topology(e));
  }
}

TEST(Surface, RefusesEveryEdgeOfTwoTrianglesBackToBack) {
  Checked checked({3, {{0, 1, 2}, {2, 1, 0}}});
  for (Index e = 0; e < checked.surface.edge_count(); ++e) EXPECT_FALSE(checked.surface.keeps_topology(e));
}

TEST(Surface, RefusesToFlattenATetrahedronThatHangsAtAVertex) {
  Shape both = test::together(test::octahedron(), test::tetrahedron(), 5);
  for (Triangle& t : both.mesh.triangles)
    for (Index& corner : t)
      if (corner == 6) corner = 0;
  Checked checked(both.mesh);
  for (const Index other : {7u, 8u, 9u}) EXPECT_FALSE(checked.surface.keeps_topology(checked.edge(0, other)));
}

TEST(Surface, RefusesToCloseAHoleOfThreeEdges) {
  Shape ball = test::sphere(1);
  const Triangle hole = ball.mesh.triangles.back();
  ball.mesh.triangles.pop_back();
  Checked checked(ball.mesh);
  for (int i = 0; i < 3; ++i)
    EXPECT_FALSE(checked.surface.keeps_topology(
        checked.edge(hole[static_cast<std::size_t>(i)], hole[static_cast<std::size_t>((i + 1) % 3)])));
}

TEST(Surface, ShortensAHoleOfFourEdges) {
  Checked checked(test::sheet(5, 5, [](Index x, Index y) { return x != 1 || y != 1; }).mesh);
  EXPECT_TRUE(checked.surface.keeps_topology(checked.edge(6, 7)));
  checked.contract(checked.edge(6, 7));
  EXPECT_TRUE(test::same_shape(test::invariants_of(checked.triangles()), test::invariants_of(checked.mesh.triangles)));
  EXPECT_FALSE(checked.surface.keeps_topology(checked.edge(11, 12)));
}

TEST(Surface, RefusesToCutTheNeckOfATorus) {
  Checked checked(test::torus(3, 5).mesh);  // three edges around the tube
  EXPECT_FALSE(checked.surface.keeps_topology(checked.edge(0, 1)));
  EXPECT_TRUE(checked.surface.keeps_topology(checked.edge(0, 3)));
}

TEST(Surface, ContractsBothWingsOfABowTieByThemselves) {
  Shape wing = test::sheet(4, 4);
  Shape both = test::together(wing, wing, 5);
  for (Triangle& t : both.mesh.triangles)
    for (Index& corner : t)
      if (corner == 16) corner = 15;  // the last corner of one is the first of the other
  Checked checked(both.mesh);
  EXPECT_EQ(checked.surface.vertex_count(), 31u);
  EXPECT_TRUE(checked.surface.keeps_topology(checked.edge(14, 15)));
  checked.contract(checked.edge(14, 15));
  EXPECT_TRUE(test::same_shape(test::invariants_of(checked.triangles()), test::invariants_of(both.mesh.triangles)));
  checked.expect_consistent();
}

// Three sheets that share their first row.
Mesh book(Index columns, Index rows) {
  Mesh mesh{columns, {}};
  for (int page = 0; page < 3; ++page) {
    const Index offset = mesh.vertex_count - columns;
    for (Triangle t : test::sheet(columns, rows).mesh.triangles) {
      for (Index& corner : t)
        if (corner >= columns) corner += offset;
      mesh.triangles.push_back(t);
    }
    mesh.vertex_count += columns * (rows - 1);
  }
  return mesh;
}

TEST(Surface, ShortensANonManifoldEdgeAndKeepsAllItsPages) {
  Checked checked(book(5, 3));
  const Index e = checked.edge(1, 2);
  ASSERT_TRUE(checked.surface.keeps_topology(e));
  checked.contract(e);
  checked.expect_consistent();
  const test::Invariants after = test::invariants_of(checked.triangles());
  EXPECT_EQ(after.euler_characteristic, test::invariants_of(checked.mesh.triangles).euler_characteristic);
  EXPECT_EQ(checked.surface.edge_count() - checked.living_edges().size(), 4u);  // the edge, and one for each page
}

TEST(Surface, RefusesAnEdgeFromANonManifoldEdgeToABorder) {
  Checked checked(book(5, 2));
  EXPECT_FALSE(checked.surface.keeps_topology(checked.edge(2, 7)));
}

TEST(Surface, ContractsThroughRepeatedTriangles) {
  Mesh mesh = test::sheet(4, 4).mesh;
  mesh.triangles.insert(mesh.triangles.end(), {mesh.triangles[7], mesh.triangles[8], mesh.triangles[8]});
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    Checked checked(mesh);
    for (auto living = checked.living_edges(); !living.empty(); living = checked.living_edges()) {
      checked.contract(living[random.below(static_cast<Index>(living.size()))]);
      checked.expect_consistent();
    }
    EXPECT_EQ(checked.surface.vertex_count(), 1u);
  }
}

TEST(Surface, KeepsAnEdgeWhoseTrianglesAreGone) {
  // Two triangles at either end of a bar of one triangle: without its thickness only an edge is left of the bar.
  Checked checked({6, {{0, 1, 2}, {2, 3, 4}, {0, 2, 5}}});
  checked.contract(checked.edge(0, 5));
  EXPECT_NE(checked.edge(checked.image[0], 2), kNone);
  checked.expect_consistent();
}

// The link condition is necessary and sufficient on manifolds: whatever it says is what becomes of the surface.
TEST(Surface, ContractsAnEdgeOfAManifoldExactlyIfItsShapeStaysTheSame) {
  Random random(2);
  const Shape shapes[] = {test::sphere(1),
                          test::sphere(2),
                          test::torus(4, 5),
                          test::torus(3, 6),
                          test::sheet(6, 5),
                          test::sheet_with_hole(7, 7),
                          test::sheet(2, 9),
                          test::octahedron(),
                          test::subdivided(test::torus(3, 3)),
                          test::sheet(9, 6, [](Index x, Index y) { return (x % 4 != 1) || y % 2 != 1; })};
  int contracted = 0, refused = 0;
  for (const Shape& shape : shapes) {
    const test::Invariants before = test::invariants_of(shape.mesh.triangles);
    ASSERT_TRUE(before.is_manifold && before.is_oriented);
    for (int round = 0; round < 8; ++round) {
      Checked checked(shape.mesh);
      for (int refused_in_a_row = 0; refused_in_a_row < 30;) {
        const auto living = checked.living_edges();
        const Index e = living[random.below(static_cast<Index>(living.size()))];
        const auto [u, v] = checked.surface.ends(e);
        std::vector<Index> image = checked.image;
        for (Index& i : image)
          if (i == v) i = u;
        const test::Invariants now = test::invariants_of(test::mapped(checked.mesh.triangles, image));
        const bool stays_the_same =  // and no ear is lost, whose edge would be left without a triangle
            test::same_shape(now, before) && now.vertex_count + 1 == static_cast<long>(checked.surface.vertex_count());
        ASSERT_EQ(checked.surface.keeps_topology(e), stays_the_same) << u << " " << v;
        if (stays_the_same) {
          checked.contract(e);
          refused_in_a_row = 0;
          ++contracted;
        } else {
          ++refused_in_a_row;
          ++refused;
        }
      }
      ASSERT_NO_FATAL_FAILURE(checked.expect_consistent());
      ASSERT_EQ(checked.surface.vertex_count(), test::invariants_of(checked.triangles()).vertex_count);
    }
  }
  EXPECT_GT(contracted, 2000);
  EXPECT_GT(refused, 2000);
}

TEST(Surface, KeepsItsListsThroughRandomContractionsOfAnything) {
  Random random(3);
  for (int round = 0; round < 60; ++round) {
    Mesh mesh{4 + random.below(16), {}};
    for (Index t = random.below(40); t > 0; --t)
      mesh.triangles.push_back(
          {random.below(mesh.vertex_count), random.below(mesh.vertex_count), random.below(mesh.vertex_count)});
    Checked checked(mesh);
    const Index components = static_cast<Index>(test::invariants_of(mesh.triangles).component_count);
    for (auto living = checked.living_edges(); !living.empty(); living = checked.living_edges()) {
      checked.contract(living[random.below(static_cast<Index>(living.size()))]);
      ASSERT_NO_FATAL_FAILURE(checked.expect_consistent());
    }
    ASSERT_EQ(checked.surface.vertex_count(), components);
  }
}

// Spheres and sheets glued together at random vertices.
Mesh glued(Random& random) {
  Shape parts = test::octahedron();
  for (int i = 0; i < 5; ++i) {
    const std::uint32_t kind = random.below(4);
    parts = test::together(parts,
                           kind == 0   ? test::tetrahedron()
                           : kind == 1 ? test::sheet(4, 3)
                           : kind == 2 ? test::octahedron()
                                       : test::torus(3, 4),
                           0);
  }
  for (int i = 0; i < 12; ++i) {
    const Index from = random.below(parts.mesh.vertex_count), to = random.below(parts.mesh.vertex_count);
    for (Triangle& t : parts.mesh.triangles)
      for (Index& corner : t)
        if (corner == from) corner = to;
  }
  return parts.mesh;
}

TEST(Surface, LeavesAVertexRegularThatTookInRegularOnesOnly) {
  Random random(4);
  for (int round = 0; round < 150; ++round) {
    Checked checked(glued(random));
    const std::vector<bool> regular = test::regular_vertices(checked.mesh.vertex_count, checked.mesh.triangles);
    for (int refused_in_a_row = 0; refused_in_a_row < 30; ++refused_in_a_row) {
      const auto living = checked.living_edges();
      if (living.empty()) break;
      const Index e = living[random.below(static_cast<Index>(living.size()))];
      if (!checked.surface.keeps_topology(e)) continue;
      checked.contract(e);
      refused_in_a_row = 0;
    }
    const std::vector<bool> regular_now = test::regular_vertices(checked.mesh.vertex_count, checked.triangles());
    for (Index v = 0; v < checked.mesh.vertex_count; ++v) {
      bool all_regular = true;
      for (Index w = 0; w < checked.mesh.vertex_count; ++w)
        if (checked.image[w] == checked.image[v]) all_regular = all_regular && regular[w];
      ASSERT_TRUE(!all_regular || regular_now[checked.image[v]]) << "round " << round << ", vertex " << v;
    }
  }
}

}  // namespace
}  // namespace limber
