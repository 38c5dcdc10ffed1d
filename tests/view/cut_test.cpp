// SPDX-License-Identifier: Apache-2.0
#include "limber/view/cut.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "limber/view/triangle_list.h"
#include "tests/view/allocations.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

using test::Surface;

// Two rows of three vertices; the clusters of the drawing in cut.h.
//
//   3---4---5        level 1: 6 = {0, 1}  7 = {2, 5}  8 = {3, 4}
//   | / | / |        level 2: 9 = {6, 7}  10 = {8}
//   0---1---2
Surface six() {
  Surface s;
  s.mesh = {6, {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}}};
  s.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  return s;
}

FrameState six_state() {
  FrameState state;
  state.hierarchy.level_begin = {0, 6, 9, 11};
  state.hierarchy.parent = {6, 6, 7, 8, 8, 7, 9, 9, 10, kNone, kNone};
  state.positions = six().positions;
  state.positions.resize(11);
  state.errors = {0, 0, 0, 0, 0, 0, 1, 2, 1.5f, 8, 1.5f};
  return state;
}

std::vector<Index> active_nodes(const Cut& cut) {
  std::vector<Index> active;
  for (Index n = 0; n < cut.labels().size(); ++n) {
    if (cut.is_active(n)) active.push_back(n);
  }
  return active;
}

// Walks up from every finest vertex.
void expect_one_active_node_on_every_path(const Cut& cut, const Hierarchy& hierarchy) {
  for (Index v = 0; v < hierarchy.vertex_count(); ++v) {
    Index active = kNone;
    for (Index n = v; n != kNone; n = hierarchy.parent[n]) {
      if (cut.is_active(n)) {
        ASSERT_EQ(active, kNone) << "two active nodes above vertex " << v;
        active = n;
      }
      ASSERT_EQ(cut.is_expanded(n), active != kNone && n != active && cut.labels()[n] == kNone);
    }
    ASSERT_NE(active, kNone) << "no active node above vertex " << v;
    ASSERT_EQ(cut.labels()[v], active);
  }
}

// Triangles whose images have three corners, equal ones counted as often as they occur.
Index living_count(const Mesh& mesh, const Cut& cut) {
  return static_cast<Index>(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    const Index a = cut.labels()[t[0]], b = cut.labels()[t[1]], c = cut.labels()[t[2]];
    return a != b && b != c && c != a;
  }));
}

TEST(Cut, OfSixVerticesByLevel) {
  const Surface s = six();
  const FrameState state = six_state();
  Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kLevel, .level = 0});
  cut.update(s.mesh, state);
  EXPECT_EQ(active_nodes(cut), std::vector<Index>({0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(cut.vertex_count(), 6u);
  cut.set_options({.by = CutBy::kLevel, .level = 1});
  cut.update(s.mesh, state);
  EXPECT_EQ(active_nodes(cut), std::vector<Index>({6, 7, 8}));
  EXPECT_EQ(cut.vertex_count(), 3u);
  cut.set_options({.by = CutBy::kLevel, .level = 7});
  cut.update(s.mesh, state);
  EXPECT_EQ(active_nodes(cut), std::vector<Index>({9, 10})) << "clamped to the top";
}

TEST(Cut, OfSixVerticesByBudgetExpandsTheDearestFirst) {
  const Surface s = six();
  const FrameState state = six_state();
  Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = 1});
  cut.update(s.mesh, state);
  EXPECT_EQ(active_nodes(cut), std::vector<Index>({8, 9}))
      << "nothing is coarser than the top, and to expand 10, which has one child, costs nothing";
  const std::vector<std::vector<Index>> expected = {
      {8, 9}, {6, 7, 8}, {2, 5, 6, 8}, {2, 3, 4, 5, 6}, {0, 1, 2, 3, 4, 5}};
  for (Index budget = 2; budget <= 6; ++budget) {
    cut.set_options({.by = CutBy::kVertices, .budget = budget});
    cut.update(s.mesh, state);
    EXPECT_EQ(active_nodes(cut), expected[budget - 2]) << budget;
    EXPECT_EQ(cut.vertex_count(), budget);
  }
}

TEST(Cut, FollowsAVertexThatMovesFromAContractedToAnExpandedParent) {
  const Surface s = six();
  FrameState state = six_state();
  Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = 4});
  cut.update(s.mesh, state);
  EXPECT_EQ(cut.labels()[1], 6u);
  EXPECT_TRUE(cut.is_expanded(7));
  apply(state.hierarchy, {1, 7});
  cut.set_options({.by = CutBy::kVertices, .budget = 5});
  cut.update(s.mesh, state);
  EXPECT_EQ(cut.labels()[1], 1u);
  EXPECT_EQ(cut.labels()[0], 0u) << "what is left in its old cluster is one vertex, and expanding that costs nothing";
}

class CutUnderSwaps : public testing::TestWithParam<CutOptions> {};

TEST_P(CutUnderSwaps, HasOneActiveNodeOnEveryPathAndKeepsItsPromise) {
  const Surface s = test::sheet(30, 31);
  FrameState state = test::patch_state(s, {930, 120, 30, 5});
  CutOptions options = GetParam();
  Cut cut(s.mesh, state.hierarchy, options);
  test::Random random(3);
  for (int frame = 0; frame < 60; ++frame) {
    cut.update(s.mesh, state);
    expect_one_active_node_on_every_path(cut, state.hierarchy);
    ASSERT_EQ(cut.vertex_count(), active_nodes(cut).size()) << "no isolated vertices here";
    if (options.by == CutBy::kLevel) {
      for (Index n = 0; n < state.hierarchy.node_count(); ++n) {
        ASSERT_EQ(cut.is_active(n), state.hierarchy.level_of(n) == std::min(options.level, 3u));
      }
    } else if (options.by == CutBy::kVertices) {
      ASSERT_LE(cut.vertex_count(), std::max(options.budget, 5u));
    } else if (options.by == CutBy::kTriangles) {
      ASSERT_LE(living_count(s.mesh, cut), options.budget);
    }
    test::deform(s.mesh, state, 60, random);
  }
}

std::string title(const testing::TestParamInfo<CutOptions>& info) {
  const CutOptions& o = info.param;
  switch (o.by) {
    case CutBy::kLevel:
      return "Level" + std::to_string(o.level);
    case CutBy::kVertices:
      return "Vertices" + std::to_string(o.budget);
    case CutBy::kTriangles:
      return "Triangles" + std::to_string(o.budget);
    case CutBy::kError:
      return o.error_bound > 0 ? "Error" : "NoError";
  }
  return "";
}

INSTANTIATE_TEST_SUITE_P(Criteria, CutUnderSwaps,
                         testing::Values(CutOptions{.by = CutBy::kLevel, .level = 0},
                                         CutOptions{.by = CutBy::kLevel, .level = 2},
                                         CutOptions{.by = CutBy::kLevel, .level = 9},
                                         CutOptions{.by = CutBy::kVertices, .budget = 0},
                                         CutOptions{.by = CutBy::kVertices, .budget = 77},
                                         CutOptions{.by = CutBy::kVertices, .budget = 400, .hysteresis = 3},
                                         CutOptions{.by = CutBy::kVertices, .budget = 5000},
                                         CutOptions{.by = CutBy::kTriangles, .budget = 150},
                                         CutOptions{.by = CutBy::kTriangles, .budget = 800, .hysteresis = 3},
                                         CutOptions{.by = CutBy::kError, .error_bound = 0.5f},
                                         CutOptions{.by = CutBy::kError, .error_bound = 0}),
                         title);

TEST(Cut, FillsAVertexBudgetUpToWhatTheNextExpansionCosts) {
  const Surface s = test::torus(40, 50);
  FrameState state = test::patch_state(s, {2000, 250, 32, 4});
  for (Index budget = 4; budget <= 2000; budget += 37) {
    Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = budget});
    cut.update(s.mesh, state);
    EXPECT_LE(cut.vertex_count(), budget);
    std::vector<Index> children(state.hierarchy.node_count(), 0);
    for (const Index p : state.hierarchy.parent) children[p == kNone ? 0 : p] += p != kNone;
    for (Index n = state.hierarchy.vertex_count(); n < state.hierarchy.node_count(); ++n) {
      if (cut.is_active(n)) {
        EXPECT_GT(cut.vertex_count() + children[n] - 1, budget) << "node " << n << " would still fit";
      }
    }
  }
}

TEST(Cut, WithABudgetForEverythingIsTheFinestLevel) {
  const Surface s = test::torus(20, 30);
  const FrameState state = test::patch_state(s, {600, 80, 10});
  for (const CutOptions& options :
       {CutOptions{.by = CutBy::kVertices, .budget = 600}, CutOptions{.by = CutBy::kTriangles, .budget = 1200}}) {
    Cut cut(s.mesh, state.hierarchy, options);
    cut.update(s.mesh, state);
    for (Index v = 0; v < 600; ++v) EXPECT_TRUE(cut.is_active(v));
  }
}

TEST(Cut, WithHysteresisOneDoesNotDependOnTheFramesBefore) {
  const Surface s = test::sheet(30, 31);
  for (const CutOptions& options : {CutOptions{.by = CutBy::kVertices, .budget = 300, .hysteresis = 1},
                                    CutOptions{.by = CutBy::kTriangles, .budget = 500, .hysteresis = 1},
                                    CutOptions{.by = CutBy::kError, .error_bound = 0.4f, .hysteresis = 1}}) {
    FrameState state = test::patch_state(s, {930, 120, 30, 5});
    Cut kept(s.mesh, state.hierarchy, options);
    test::Random random(5);
    for (int frame = 0; frame < 30; ++frame) {
      kept.update(s.mesh, state);
      Cut fresh(s.mesh, state.hierarchy, options);
      fresh.update(s.mesh, state);
      ASSERT_TRUE(std::equal(kept.labels().begin(), kept.labels().end(), fresh.labels().begin()));
      test::deform(s.mesh, state, 60, random);
    }
  }
}

TEST(Cut, WithHysteresisChangesLess) {
  const Surface s = test::sheet(30, 31);
  std::size_t changes[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    FrameState state = test::patch_state(s, {930, 120, 30, 5});
    Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = 300, .hysteresis = i == 0 ? 1.0f : 1.25f});
    cut.update(s.mesh, state);
    test::Random random(5);
    for (int frame = 0; frame < 30; ++frame) {
      const std::vector<Index> before(cut.labels().begin(), cut.labels().end());
      test::deform(s.mesh, state, 0, random);
      cut.update(s.mesh, state);
      for (std::size_t n = 0; n < before.size(); ++n) changes[i] += before[n] != cut.labels()[n];
    }
  }
  EXPECT_LT(2 * changes[1], changes[0]);
}

TEST(Cut, WithinAnErrorBoundHoldsItAndExpandsNothingWithoutNeed) {
  const Surface s = test::sheet(30, 31);
  FrameState state = test::patch_state(s, {930, 120, 30, 5});
  Box box;
  for (const Vec3f& p : s.positions) box.add(Vec3d(p));
  std::vector<double> area(state.hierarchy.node_count(), 0.0);
  for (const Triangle& t : s.mesh.triangles) {
    const Vec3d a(s.positions[t[0]]), b(s.positions[t[1]]), c(s.positions[t[2]]);
    for (const Index corner : t) {
      for (Index n = corner; n != kNone; n = state.hierarchy.parent[n]) area[n] += length(cross(b - a, c - a)) / 6;
    }
  }
  Index last_count = 0;
  for (const float bound : {4.0f, 2.0f, 1.0f, 0.5f, 0.2f, 0.0f}) {
    Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kError, .error_bound = bound});
    cut.update(s.mesh, state);
    const double limit = double{bound} / 100 * box.diagonal();
    for (Index n = 0; n < state.hierarchy.node_count(); ++n) {
      const double distance = state.errors[n] > 0 ? double{state.errors[n]} / std::sqrt(area[n]) : 0;
      if (cut.is_active(n)) {
        EXPECT_LE(distance, limit * (1 + 1e-9));
      }
      if (cut.is_expanded(n)) {
        EXPECT_GT(distance, limit * (1 - 1e-9));
      }
    }
    EXPECT_GE(cut.vertex_count(), last_count) << "a tighter bound is no coarser";
    last_count = cut.vertex_count();
  }
  EXPECT_GT(last_count, 900u);
}

TEST(Cut, UnderAnErrorBoundKeepsANodeWhoseSquaredErrorIsNearIt) {
  const Surface s = test::torus(30, 40);
  FrameState state = test::patch_state(s, {1200, 150, 20});
  const Index top = state.hierarchy.level_begin[2];
  Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kError, .error_bound = 0, .hysteresis = 1.6f});
  cut.update(s.mesh, state);
  ASSERT_TRUE(cut.is_expanded(top));
  float bound = 1000;  // the least that contracts the node, by bisection
  float low = 0;
  for (int i = 0; i < 40; ++i) {
    const float middle = (low + bound) / 2;
    Cut fresh(s.mesh, state.hierarchy, {.by = CutBy::kError, .error_bound = middle});
    fresh.update(s.mesh, state);
    (fresh.is_expanded(top) ? low : bound) = middle;
  }
  cut.set_options({.by = CutBy::kError, .error_bound = bound * std::sqrt(1.59f), .hysteresis = 1.6f});
  cut.update(s.mesh, state);
  EXPECT_TRUE(cut.is_expanded(top));
  cut.set_options({.by = CutBy::kError, .error_bound = bound * std::sqrt(1.61f), .hysteresis = 1.6f});
  cut.update(s.mesh, state);
  EXPECT_FALSE(cut.is_expanded(top));
}

TEST(Cut, OfATighterBoundRefinesThatOfAWiderOne) {
  const Surface s = test::torus(30, 40);
  const FrameState state = test::patch_state(s, {1200, 150, 20});
  Cut wide(s.mesh, state.hierarchy, {.by = CutBy::kError, .error_bound = 1.0f});
  Cut tight(s.mesh, state.hierarchy, {.by = CutBy::kError, .error_bound = 0.3f});
  wide.update(s.mesh, state);
  tight.update(s.mesh, state);
  for (Index n = 0; n < state.hierarchy.node_count(); ++n) EXPECT_LE(wide.is_expanded(n), tight.is_expanded(n));
}

TEST(Cut, DoesNotChargeIsolatedVertices) {
  Surface s = test::torus(10, 20);
  s.mesh.vertex_count += 50;
  s.mesh.triangles.push_back({3, 3, 200});  // degenerate: draws nothing
  for (int i = 0; i < 50; ++i) s.positions.push_back({0, 0, static_cast<float>(i)});
  FrameState state;
  state.positions = s.positions;
  Hierarchy& h = state.hierarchy;
  h.level_begin = {0, 250, 325, 385};  // each isolated vertex has a path of its own
  for (Index v = 0; v < 200; ++v) h.parent.push_back(250 + v / 8);
  for (Index v = 0; v < 50; ++v) h.parent.push_back(275 + v);
  for (Index n = 0; n < 25; ++n) h.parent.push_back(325 + n / 3);
  for (Index n = 0; n < 50; ++n) h.parent.push_back(335 + n);
  h.parent.resize(h.node_count(), kNone);
  h.parent[250 + 24] = 334;
  h.parent[250 + 23] = 333;
  test::place_nodes(s.mesh, state);
  for (const Index budget : {10u, 40u, 113u, 200u}) {
    Cut cut(s.mesh, h, {.by = CutBy::kVertices, .budget = budget});
    cut.update(s.mesh, state);
    EXPECT_LE(cut.vertex_count(), budget);
    EXPECT_GT(cut.vertex_count() + 8, budget);
    EXPECT_EQ(active_nodes(cut).size(), cut.vertex_count() + 50);
    if (budget < 200) continue;
    for (Index v = 0; v < 250; ++v) EXPECT_TRUE(cut.is_active(v)) << "everything, isolated vertices too";
  }
}

TEST(Cut, OfAHierarchyOfOneLevelIsThatLevel) {
  const Surface s = six();
  FrameState state;
  state.hierarchy = {{0, 6}, std::vector<Index>(6, kNone)};
  state.positions = s.positions;
  state.errors.assign(6, 0.0f);
  for (const CutBy by : {CutBy::kLevel, CutBy::kVertices, CutBy::kTriangles, CutBy::kError}) {
    Cut cut(s.mesh, state.hierarchy, {.by = by, .level = 3, .budget = 2});
    cut.update(s.mesh, state);
    EXPECT_EQ(active_nodes(cut), std::vector<Index>({0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(cut.vertex_count(), 6u);
  }
}

TEST(Cut, DoesNotAllocateInAnUpdate) {
  const Surface s = test::sheet(30, 31);
  for (const CutBy by : {CutBy::kLevel, CutBy::kVertices, CutBy::kTriangles, CutBy::kError}) {
    FrameState state = test::patch_state(s, {930, 120, 30, 5});
    Cut cut(s.mesh, state.hierarchy, {.by = by, .level = 1, .budget = 300});
    test::Random random(5);
    for (int frame = 0; frame < 10; ++frame) {
      const std::size_t before = test::allocation_count();
      cut.update(s.mesh, state);
      EXPECT_EQ(test::allocation_count(), before);
      test::deform(s.mesh, state, 60, random);
    }
  }
}

}  // namespace
}  // namespace limber
