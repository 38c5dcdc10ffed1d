// SPDX-License-Identifier: Apache-2.0
#include "limber/view/extract.h"

#include <cmath>
#include <gtest/gtest.h>

#include "tests/view/allocations.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

using test::Surface;

struct Extracted {
  MeshBuffers buffers;
  ExtractScratch scratch;
};

Extracted extract_by(const Mesh& mesh, const FrameState& state, const CutOptions& cut_options,
                     const ExtractOptions& options = {}) {
  Cut cut(mesh, state.hierarchy, cut_options);
  cut.update(mesh, state);
  Extracted result;
  extract(mesh, state, cut, result.scratch, result.buffers, options);
  return result;
}

// Invariants of all buffers: compact, in rising order of nodes, positions of the nodes, normals of length 1.
void expect_sound(const MeshBuffers& buffers, const FrameState& state) {
  ASSERT_EQ(buffers.positions.size(), buffers.nodes.size());
  ASSERT_EQ(buffers.normals.size(), buffers.nodes.size());
  ASSERT_EQ(buffers.indices.size() % 3, 0u);
  std::vector<bool> used(buffers.nodes.size(), false);
  for (const Index v : buffers.indices) {
    ASSERT_LT(v, used.size());
    used[v] = true;
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    ASSERT_TRUE(used[v]);
    ASSERT_TRUE(v == 0 || buffers.nodes[v - 1] < buffers.nodes[v]);
    ASSERT_EQ(buffers.positions[v], state.positions[buffers.nodes[v]]);
    ASSERT_NEAR(length(buffers.normals[v]), 1, 1e-6);
  }
}

TEST(Extract, OfLevelZeroIsTheInputWithoutIsolatedVertices) {
  Surface s = test::sheet(4, 5);
  s.mesh.vertex_count += 2;
  s.positions.push_back({7, 7, 7});
  s.positions.push_back({8, 8, 8});
  s.mesh.triangles.insert(s.mesh.triangles.begin(), {3, 3, 4});
  s.mesh.triangles.push_back(s.mesh.triangles.back());
  FrameState state;
  state.hierarchy = {{0, 22, 44}, {}};
  for (Index v = 0; v < 22; ++v) state.hierarchy.parent.push_back(22 + v);
  state.hierarchy.parent.resize(44, kNone);
  state.positions = s.positions;
  test::place_nodes(s.mesh, state);

  const MeshBuffers compact = extract_by(s.mesh, state, {.by = CutBy::kLevel, .level = 0}).buffers;
  expect_sound(compact, state);
  EXPECT_EQ(compact.vertex_count(), 20u);
  ASSERT_EQ(compact.triangle_count() + 1, s.mesh.triangles.size())
      << "all but the degenerate one, the repeated one too";
  for (std::size_t i = 0; i < compact.indices.size(); ++i) {
    EXPECT_EQ(compact.nodes[compact.indices[i]], s.mesh.triangles[i / 3 + 1][i % 3]);
  }

  const Extracted whole = extract_by(s.mesh, state, {.by = CutBy::kLevel, .level = 0}, {.whole_input = true});
  ASSERT_EQ(whole.buffers.positions, s.positions);
  ASSERT_EQ(whole.buffers.triangle_count(), s.mesh.triangles.size());
  EXPECT_EQ(whole.scratch.list.triangles, s.mesh.triangles);
  for (std::size_t i = 0; i < whole.buffers.indices.size(); ++i) {
    EXPECT_EQ(whole.buffers.indices[i], s.mesh.triangles[i / 3][i % 3]);
  }
  for (const Vec3f& normal : whole.buffers.normals) EXPECT_NEAR(length(normal), 1, 1e-6);

  const MeshBuffers coarser =
      extract_by(s.mesh, state, {.by = CutBy::kLevel, .level = 1}, {.whole_input = true}).buffers;
  EXPECT_EQ(coarser.vertex_count(), 20u) << "the option concerns level 0 alone";
}

TEST(Extract, GivesNormalsThatPointOutwards) {
  const Surface s = test::torus(40, 60);
  const FrameState state = test::patch_state(s, {2400, 300, 40});
  for (const CutOptions& options :
       {CutOptions{.by = CutBy::kLevel, .level = 0}, CutOptions{.by = CutBy::kVertices, .budget = 1200}}) {
    const MeshBuffers buffers = extract_by(s.mesh, state, options).buffers;
    expect_sound(buffers, state);
    Index outwards = 0;
    for (Index v = 0; v < buffers.vertex_count(); ++v) {
      const Vec3f p = buffers.positions[v];
      const float ring = std::sqrt(p.x * p.x + p.y * p.y);
      outwards += dot(buffers.normals[v], Vec3f{p.x - 3 * p.x / ring, p.y - 3 * p.y / ring, p.z}) > 0;
    }
    EXPECT_GE(outwards, buffers.vertex_count() * 49 / 50);
  }
}

// Ten tori of 36 vertices, 6 x 6; a node of level 2 is a whole torus.
TEST(Extract, OfManyPartsHoldsAVertexBudgetBelowTheirNumber) {
  Surface s;
  for (Index part = 0; part < 10; ++part) {
    const Surface one = test::torus(6, 6);
    for (const Triangle& t : one.mesh.triangles) {
      s.mesh.triangles.push_back({t[0] + 36 * part, t[1] + 36 * part, t[2] + 36 * part});
    }
    for (const Vec3f& p : one.positions) s.positions.push_back(p * static_cast<float>(part + 1));
  }
  s.mesh.vertex_count = 360;
  FrameState state;
  state.hierarchy.level_begin = {0, 360, 480, 490};
  for (Index v = 0; v < 360; ++v) state.hierarchy.parent.push_back(360 + v / 3);
  for (Index n = 0; n < 120; ++n) state.hierarchy.parent.push_back(480 + n / 12);
  state.hierarchy.parent.resize(490, kNone);
  state.positions = s.positions;
  test::place_nodes(s.mesh, state);
  for (Index budget = 0; budget <= 360; ++budget) {
    Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = budget});
    cut.update(s.mesh, state);
    Extracted result;
    extract(s.mesh, state, cut, result.scratch, result.buffers);
    ASSERT_LE(cut.vertex_count(), budget);
    ASSERT_EQ(result.buffers.vertex_count(), cut.vertex_count());
    ASSERT_GT(cut.vertex_count() + 12, budget);
  }
}

TEST(Extract, GivesAFlatSheetOneNormal) {
  const Mesh mesh{4, {{0, 1, 2}, {0, 2, 3}}};
  FrameState state;
  state.hierarchy = {{0, 4}, std::vector<Index>(4, kNone)};
  state.positions = {{0, 0, 1e-18f}, {1e-18f, 0, 1e-18f}, {1e-18f, 1e-18f, 1e-18f}, {0, 1e-18f, 1e-18f}};
  state.errors.assign(4, 0.0f);
  const MeshBuffers buffers = extract_by(mesh, state, {}).buffers;
  for (const Vec3f& normal : buffers.normals) EXPECT_EQ(normal, (Vec3f{0, 0, 1})) << "however small it is";
}

TEST(Extract, GivesTrianglesWithoutAreaANormalThatIsANumber) {
  const Mesh mesh{3, {{0, 1, 2}}};
  FrameState state;
  state.hierarchy = {{0, 3}, std::vector<Index>(3, kNone)};
  state.positions = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  state.errors.assign(3, 0.0f);
  const MeshBuffers buffers = extract_by(mesh, state, {}).buffers;
  ASSERT_EQ(buffers.vertex_count(), 3u);
  for (const Vec3f& normal : buffers.normals) EXPECT_EQ(normal, (Vec3f{0, 0, 1}));
}

TEST(Extract, IntoUsedBuffersIsExtractionFromScratch) {
  const Surface s = test::sheet(30, 31);
  FrameState state = test::patch_state(s, {930, 120, 30, 5});
  Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = 200});
  test::Random random(11);
  Extracted kept;
  for (int frame = 0; frame < 60; ++frame) {
    cut.set_options({.by = CutBy::kVertices, .budget = 20 + random.below(700), .hysteresis = 1});
    cut.update(s.mesh, state);
    extract(s.mesh, state, cut, kept.scratch, kept.buffers);
    expect_sound(kept.buffers, state);
    ASSERT_LE(kept.buffers.vertex_count(), cut.vertex_count());
    const MeshBuffers fresh = extract_by(s.mesh, state, cut.options()).buffers;
    ASSERT_EQ(kept.buffers.nodes, fresh.nodes);
    ASSERT_EQ(kept.buffers.indices, fresh.indices);
    ASSERT_EQ(kept.buffers.normals, fresh.normals);
    for (std::size_t i = 0; i < kept.buffers.indices.size(); ++i) {
      ASSERT_EQ(kept.buffers.nodes[kept.buffers.indices[i]], kept.scratch.list.triangles[i / 3][i % 3]);
    }
    test::deform(s.mesh, state, 60, random);
  }
}

TEST(Extract, DoesNotAllocateOnceBuffersHaveBeenAsLarge) {
  const Surface s = test::sheet(30, 31);
  FrameState state = test::patch_state(s, {930, 120, 30, 5});
  Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kLevel, .level = 0});
  Extracted kept;
  cut.update(s.mesh, state);
  extract(s.mesh, state, cut, kept.scratch, kept.buffers);
  cut.set_options({.by = CutBy::kVertices, .budget = 300});
  test::Random random(1);
  for (int frame = 0; frame < 20; ++frame) {
    test::deform(s.mesh, state, 60, random);
    const std::size_t before = test::allocation_count();
    cut.update(s.mesh, state);
    extract(s.mesh, state, cut, kept.scratch, kept.buffers);
    EXPECT_EQ(test::allocation_count(), before);
  }
}

}  // namespace
}  // namespace limber
