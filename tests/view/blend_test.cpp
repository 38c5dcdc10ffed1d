// SPDX-License-Identifier: Apache-2.0
#include "limber/view/blend.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <utility>

#include "limber/view/extract.h"
#include "limber/view/player.h"
#include "tests/view/allocations.h"
#include "tests/view/patches.h"
#include "tests/view/player_stream.h"

namespace limber {
namespace {

using test::Surface;

// Two rows of five vertices. Level 1: 10 = {0, 5}, 11 = {6, 7}, 12 = {2}, 13 = {3, 8}, 14 = {4, 9}, 15 = {1}.
//
//   5---6---7---8---9
//   | / | / | / | / |
//   0---1---2---3---4
struct Ladder {
  Surface surface;
  FrameState state;

  Ladder() {
    for (Index x = 0; x + 1 < 5; ++x) {
      surface.mesh.triangles.push_back({x, x + 1, x + 6});
      surface.mesh.triangles.push_back({x, x + 6, x + 5});
    }
    surface.mesh.vertex_count = 10;
    for (Index v = 0; v < 10; ++v)
      surface.positions.push_back(
          {static_cast<float>(v % 5), static_cast<float>(v / 5), static_cast<float>(v * v % 7)});
    state.hierarchy = {{0, 10, 16}, {10, 15, 12, 13, 14, 10, 11, 11, 13, 14}};
    state.hierarchy.parent.resize(16, kNone);
    state.positions = surface.positions;
    test::place_nodes(surface.mesh, state);
  }

  // The next frame, to which these swaps lead; nodes go on a little.
  void step(const std::vector<Swap>& swaps) {
    for (const Swap& swap : swaps) apply(state.hierarchy, swap);
    for (Index v = 0; v < 10; ++v) state.positions[v] += Vec3f{0.125f, static_cast<float>(v) / 16, 0};
    test::place_nodes(surface.mesh, state);
    ++state.frame;
  }
};

CutOptions level(Index k) { return {.by = CutBy::kLevel, .level = k}; }

Vec3f between(const Vec3f& a, const Vec3f& b, float s) { return (1 - s) * a + s * b; }

void expect_near(const Vec3f& a, const Vec3f& b, float tolerance = 1e-5f) {
  EXPECT_LE(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z << "; " << b.x << ' ' << b.y << ' ' << b.z;
}

std::vector<Index> labels_of(const Cut& cut, Index vertex_count) {
  return {cut.labels().begin(), cut.labels().begin() + vertex_count};
}

void expect_shows(const Blend& blend, const Cut& cut, const FrameState& state) {
  EXPECT_EQ(blend.moving_count(), 0u);
  EXPECT_TRUE(std::equal(blend.labels().begin(), blend.labels().end(), cut.labels().begin()));
  EXPECT_TRUE(std::equal(state.positions.begin(), state.positions.end(), blend.positions().begin()));
}

class BlendOfALadder : public testing::Test {
 protected:
  explicit BlendOfALadder(Index frames = 4)
      : cut_(ladder_.surface.mesh, ladder_.state.hierarchy, level(1)),
        blend_(ladder_.surface.mesh, ladder_.state.hierarchy, {.frames = frames}) {
    update();
  }

  void update() {
    cut_.update(ladder_.surface.mesh, ladder_.state);
    blend_.update(ladder_.state, cut_);
  }
  void step(const std::vector<Swap>& swaps = {}) {
    ladder_.step(swaps);
    update();
  }
  const Vec3f& at(Index node) const { return ladder_.state.positions[node]; }
  Vec3f drawn(Index v) const { return blend_.positions()[blend_.labels()[v]]; }

  Ladder ladder_;
  Cut cut_;
  Blend blend_;
};

TEST_F(BlendOfALadder, MovesAVertexToItsNewNodeInEqualSteps) {
  expect_shows(blend_, cut_, ladder_.state);
  step({{7, 13}});
  for (Index k = 1; k < 4; ++k) {
    EXPECT_EQ(blend_.labels()[7], 16u);
    EXPECT_EQ(blend_.moving_count(), 1u);
    expect_near(drawn(7), between(at(11), at(13), static_cast<float>(k) / 4));
    for (Index v = 0; v < 10; ++v) {
      if (v != 7) {
        EXPECT_EQ(blend_.labels()[v], cut_.labels()[v]);
      }
    }
    step();
  }
  expect_shows(blend_, cut_, ladder_.state);
}

TEST_F(BlendOfALadder, DoesNotMoveWhatChangesNoTriangle) {
  step({{5, 11}});
  expect_shows(blend_, cut_, ladder_.state);
}

TEST_F(BlendOfALadder, GoesOnFromWhereItStandsWhenItTurnsOff) {
  step({{7, 13}});
  step();
  step({{7, 12}});
  const Vec3f from = between(at(11), at(13), 0.5f);
  expect_near(drawn(7), between(from, at(12), 0.25f));
  step();
  expect_near(drawn(7), between(between(at(11), at(13), 0.5f), at(12), 0.5f));
  step({{7, 11}});
  expect_near(drawn(7), between(between(between(at(11), at(13), 0.5f), at(12), 0.5f), at(11), 0.25f));
  step();
  step();
  step();
  expect_shows(blend_, cut_, ladder_.state);
}

// Node 13 loses all it has and takes what 10 had, far away; what was in it goes on from where it was.
TEST_F(BlendOfALadder, CarriesOnWhatANodeLostThatWasBornAgainElsewhere) {
  const Vec3f old_place = at(13);
  step({{3, 12}, {8, 14}, {0, 13}, {5, 13}, {1, 10}});
  for (Index k = 1; k < 4; ++k) {
    for (const auto& [v, to] : {std::pair(3u, 12u), std::pair(8u, 14u)}) {
      ASSERT_GE(blend_.labels()[v], 16u);
      const Vec3f motion{0.125f, static_cast<float>(v) / 16, 0};
      expect_near(drawn(v), between(old_place + static_cast<float>(k) * motion, at(to), static_cast<float>(k) / 4));
    }
    EXPECT_GE(blend_.labels()[0], 16u);
    step();
  }
  expect_shows(blend_, cut_, ladder_.state);
}

TEST_F(BlendOfALadder, StartsAgainAfterASeekAndWhereTheCutIsAnother) {
  step({{7, 13}});
  ASSERT_EQ(blend_.moving_count(), 1u);
  ladder_.step({{6, 10}});
  step();
  expect_shows(blend_, cut_, ladder_.state);

  step({{7, 12}});
  ASSERT_EQ(blend_.moving_count(), 1u);
  cut_.set_options(level(0));
  step();
  expect_shows(blend_, cut_, ladder_.state);
  update();
  expect_shows(blend_, cut_, ladder_.state);
}

TEST_F(BlendOfALadder, StaysAsItIsWhenTheSameFrameIsShownAgain) {
  step({{7, 13}});
  const Vec3f place = drawn(7);
  update();
  EXPECT_EQ(drawn(7), place);
  EXPECT_EQ(blend_.moving_count(), 1u);
}

TEST_F(BlendOfALadder, ShowsAHierarchyThatBeginsAnewAsItIs) {
  step({{0, 14}, {1, 13}, {2, 11}, {3, 10}, {4, 10}, {5, 12}, {8, 12}});
  expect_shows(blend_, cut_, ladder_.state);
}

// One vertex goes to a node anywhere in every frame, more often than it has shares, and most of its nodes die; nothing
// else moves.
TEST(Blend, GoesOnFromWhereItStandsHoweverOftenItTurnsOff) {
  const Surface s = test::sheet(9, 9);
  FrameState state = test::patch_state(s, {81, 81});
  Cut cut(s.mesh, state.hierarchy, level(1));
  Blend blend(s.mesh, state.hierarchy, {.frames = 4});
  cut.update(s.mesh, state);
  blend.update(state, cut);
  test::Random random(5);
  Vec3f place = state.positions[40];
  for (int frame = 0; frame < 60; ++frame) {
    Index to = state.hierarchy.parent[40];
    while (to == state.hierarchy.parent[40]) to = 81 + random.below(81);
    apply(state.hierarchy, {40, to});
    ++state.frame;
    cut.update(s.mesh, state);
    blend.update(state, cut);
    ASSERT_EQ(blend.moving_count(), 1u);
    place = between(place, state.positions[to], 0.25f);
    expect_near(blend.positions()[blend.labels()[40]], place, 1e-4f);
    float sum = 0;
    for (const Blend::Share& share : blend.shares(blend.labels()[40] - blend.node_count())) {
      EXPECT_GT(share.weight, 0);
      sum += share.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-5f);
  }
}

TEST(Blend, OfNoneOrOneFrameIsTheCut) {
  for (const Index frames : {0u, 1u}) {
    const Surface s = test::sheet(30, 31);
    FrameState state = test::patch_state(s, {930, 120, 30, 5});
    Cut cut(s.mesh, state.hierarchy, {.by = CutBy::kVertices, .budget = 200});
    Blend blend(s.mesh, state.hierarchy, {.frames = frames});
    test::Random random(2);
    ExtractScratch scratch, plain_scratch;
    MeshBuffers buffers, plain;
    for (int frame = 0; frame < 20; ++frame) {
      cut.update(s.mesh, state);
      blend.update(state, cut);
      extract(s.mesh, blend, scratch, buffers);
      extract(s.mesh, state, cut, plain_scratch, plain);
      ASSERT_EQ(buffers.positions, plain.positions);
      ASSERT_EQ(buffers.normals, plain.normals);
      ASSERT_EQ(buffers.indices, plain.indices);
      ASSERT_EQ(buffers.nodes, plain.nodes);
      test::deform(s.mesh, state, 30, random);
    }
  }
}

// What a blend shows must be a blend: labels are active nodes or moving vertices in use, each of which has a vertex.
void expect_sound(const Blend& blend, const Cut& cut) {
  std::vector<Index> vertex_count(blend.path_count(), 0);
  for (Index v = 0; v < blend.labels().size(); ++v) {
    const Index label = blend.labels()[v];
    ASSERT_LT(label, blend.positions().size());
    ASSERT_TRUE(is_finite(blend.positions()[label]));
    if (label < blend.node_count()) {
      ASSERT_EQ(label, cut.labels()[v]);
    } else {
      ++vertex_count[label - blend.node_count()];
    }
  }
  Index moving = 0;
  for (Index path = 0; path < blend.path_count(); ++path) {
    const Blend::Shares shares = blend.shares(path);
    ASSERT_EQ(shares.begin() == shares.end(), vertex_count[path] == 0);
    moving += vertex_count[path] > 0;
  }
  ASSERT_EQ(moving, blend.moving_count());
}

template <class Label>
std::set<Triangle> images(const Mesh& mesh, Label&& label) {
  std::set<Triangle> images;
  for (const Triangle& t : mesh.triangles) {
    Triangle image{label(t[0]), label(t[1]), label(t[2])};
    if (is_degenerate(image)) continue;
    std::rotate(image.begin(), std::min_element(image.begin(), image.end()), image.end());
    images.insert(image);
  }
  return images;
}

// Steps that are too small to see: in the first frame the surface is the old one, at the new positions.
TEST(Blend, BeginsWithTheSurfaceOfTheLabelsBefore) {
  const Surface s = test::sheet(24, 25);
  FrameState state = test::patch_state(s, {600, 120, 20});
  test::Random random(8);
  for (int trial = 0; trial < 12; ++trial) {
    Cut cut(s.mesh, state.hierarchy, level(1));
    Blend blend(s.mesh, state.hierarchy, {.frames = 1u << 20});
    cut.update(s.mesh, state);
    blend.update(state, cut);
    const std::vector<Index> before = labels_of(cut, 600);
    test::deform(s.mesh, state, 12, random);
    test::place_nodes(s.mesh, state);
    cut.update(s.mesh, state);
    blend.update(state, cut);
    expect_sound(blend, cut);
    ASSERT_GT(blend.moving_count(), 0u);
    // Moving vertices lie where they begin; what went at once left all triangles as they were.
    const auto at_beginning = [&](Index v) {
      return blend.labels()[v] < blend.node_count() ? blend.labels()[v] : before[v];
    };
    for (Index v = 0; v < 600; ++v) {
      if (blend.labels()[v] < blend.node_count()) continue;
      expect_near(blend.positions()[blend.labels()[v]], state.positions[before[v]], 1e-4f);
    }
    EXPECT_EQ(images(s.mesh, at_beginning), images(s.mesh, [&](Index v) { return before[v]; }));
  }
}

TEST(Blend, ArrivesAtTheCutWhenNothingMoreChanges) {
  const Surface s = test::sheet(30, 31);
  for (const Index frames : {2u, 3u, 8u}) {
    FrameState state = test::patch_state(s, {930, 120, 30, 5});
    for (const CutOptions& options : {level(1), level(2), CutOptions{.by = CutBy::kVertices, .budget = 150}}) {
      Cut cut(s.mesh, state.hierarchy, options);
      Blend blend(s.mesh, state.hierarchy, {.frames = frames});
      test::Random random(4);
      for (int frame = 0; frame < 30; ++frame) {
        cut.update(s.mesh, state);
        blend.update(state, cut);
        expect_sound(blend, cut);
        test::deform(s.mesh, state, 20, random);
        test::place_nodes(s.mesh, state);
      }
      for (Index frame = 0; frame < frames; ++frame) {
        cut.update(s.mesh, state);
        blend.update(state, cut);
        expect_sound(blend, cut);
        ++state.frame;
      }
      expect_shows(blend, cut, state);
    }
  }
}

// While a moving vertex lies on the node it comes from, both have the normal that the node had.
TEST(Blend, BeginsWithTheNormalsOfTheLabelsBefore) {
  BlendOptions options{.frames = 1u << 20};
  Ladder ladder;
  Cut cut(ladder.surface.mesh, ladder.state.hierarchy, level(1));
  Blend blend(ladder.surface.mesh, ladder.state.hierarchy, options);
  ExtractScratch scratch;
  MeshBuffers before, after;
  cut.update(ladder.surface.mesh, ladder.state);
  blend.update(ladder.state, cut);
  extract(ladder.surface.mesh, blend, scratch, before);
  apply(ladder.state.hierarchy, {7, 13});  // the positions stay
  ++ladder.state.frame;
  cut.update(ladder.surface.mesh, ladder.state);
  blend.update(ladder.state, cut);
  extract(ladder.surface.mesh, blend, scratch, after);
  ASSERT_EQ(after.nodes.back(), 16u);
  ASSERT_EQ(after.nodes.size(), before.nodes.size() + 1);
  for (std::size_t v = 0; v < before.nodes.size(); ++v) {
    ASSERT_EQ(after.nodes[v], before.nodes[v]);
    expect_near(after.normals[v], before.normals[v], 1e-4f);
    if (before.nodes[v] == 11) expect_near(after.normals.back(), before.normals[v], 1e-4f);
  }
}

TEST(Blend, DoesNotAllocateWhereThereHaveBeenAsManyChanges) {
  const test::Bytes bytes = test::make_stream();
  Player player;
  ASSERT_TRUE(player.open(bytes));
  Cut cut(player.mesh(), player.state().hierarchy, level(1));
  Blend blend(player.mesh(), player.state().hierarchy, {.frames = 3});
  ExtractScratch scratch;
  MeshBuffers buffers;
  std::vector<std::vector<Vec3f>> first(player.available_frames());
  std::size_t moving = 0;
  for (int round = 0; round < 2; ++round) {
    const std::size_t before = test::allocation_count();
    for (std::uint32_t frame = 0; frame < player.available_frames(); ++frame) {
      ASSERT_TRUE(player.seek(frame));
      cut.update(player.mesh(), player.state());
      blend.update(player.state(), cut);
      extract(player.mesh(), blend, scratch, buffers);
      moving += blend.moving_count();
      if (round == 0) {
        first[frame] = buffers.positions;
      } else {
        EXPECT_EQ(first[frame], buffers.positions) << "as the first time";
      }
    }
    if (round == 1) {
      EXPECT_EQ(test::allocation_count(), before);
    }
  }
  EXPECT_GT(moving, 20u);
}

// After a seek a blend is that of a player that began there.
TEST(Blend, OfAStreamWithManySwapsIsSoundAfterAnySeek) {
  const test::Bytes bytes = test::make_stream();
  Player player;
  ASSERT_TRUE(player.open(bytes));
  const CutOptions options{.by = CutBy::kVertices, .budget = 25, .hysteresis = 1};
  Cut cut(player.mesh(), player.state().hierarchy, options);
  Blend blend(player.mesh(), player.state().hierarchy, {.frames = 4});
  for (std::uint32_t from = 0; from + 6 < player.available_frames(); ++from) {
    Blend fresh(player.mesh(), player.state().hierarchy, {.frames = 4});
    for (std::uint32_t frame = from; frame < from + 6; ++frame) {
      ASSERT_TRUE(player.seek(frame));
      cut.update(player.mesh(), player.state());
      blend.update(player.state(), cut);
      fresh.update(player.state(), cut);
      expect_sound(blend, cut);
      ASSERT_TRUE(std::equal(blend.labels().begin(), blend.labels().end(), fresh.labels().begin()));
      for (Index v = 0; v < blend.labels().size(); ++v) {
        const Index label = blend.labels()[v];
        ASSERT_EQ(blend.positions()[label], fresh.positions()[label]);
      }
    }
  }
}

}  // namespace
}  // namespace limber
