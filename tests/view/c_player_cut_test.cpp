// SPDX-License-Identifier: Apache-2.0
// What the C interface draws, by every option of a cut.
#include <algorithm>
#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <utility>
#include <vector>

#include "limber/player.h"
#include "limber/view/cut.h"
#include "limber/view/extract.h"
#include "limber/view/player.h"
#include "limber/view/view.h"
#include "tests/view/allocations.h"
#include "tests/view/c_player.h"
#include "tests/view/player_stream.h"

namespace limber {
namespace {

using test::by_vertices;
using test::Bytes;
using test::Drawn;
using test::drawn;
using test::expect_frames;
using test::info_of;
using test::kFinestCount;
using test::kFrameCount;
using test::make_stream;
using test::OwnedCut;
using test::OwnedPlayer;
using test::play_in_cpp;
using test::player_of;

TEST(CPlayer, GivesWhatTheCppPlayerGivesByEveryCriterion) {
  const Bytes bytes = make_stream();
  for (std::uint32_t by = LIMBER_BY_LEVEL; by <= LIMBER_BY_ERROR; ++by) {
    limber_cut_options options = LIMBER_CUT_DEFAULTS;
    options.by = by;
    options.level = 1;
    options.budget = by == LIMBER_BY_TRIANGLES ? 90 : 60;
    options.error_bound = 2;
    const std::vector<Drawn> expected =
        play_in_cpp(bytes, {.by = static_cast<CutBy>(by), .level = 1, .budget = options.budget, .error_bound = 2});
    SCOPED_TRACE(by);
    expect_frames(bytes, options, expected);
  }
}

// A view and what the same is in C++.
struct Looks {
  limber_view view;
  View same;
};

void put(const std::array<double, 3>& place, double (&to)[3]) { std::copy(place.begin(), place.end(), to); }

Looks through_a_camera() {
  limber_view view = LIMBER_VIEW_DEFAULTS;
  view.criteria = LIMBER_VIEW_CAMERA;
  put({4.0, -9.0, 7.0}, view.eye);
  put({5.0, 6.0, 0.0}, view.target);
  put({0.0, 0.0, 1.0}, view.up);
  view.fov_degrees = 20;
  view.width = 320;
  view.height = 200;
  view.silhouettes = 3;
  view.facing_away = 5;
  return {view,
          {.camera = Camera{.eye = {4, -9, 7}, .target = {5, 6, 0}, .up = {0, 0, 1}, .fov_degrees = 20},
           .width = 320,
           .height = 200,
           .silhouettes = 3,
           .facing_away = 5}};
}

Looks without_a_camera() {
  limber_view view = LIMBER_VIEW_DEFAULTS;
  view.criteria = LIMBER_VIEW_FOCUS | LIMBER_VIEW_ALONG;
  put({2.0, 3.0, 0.5}, view.focus_center);
  view.focus_radius = 2.5;
  view.focus_outside = 20;
  view.along_axis = 1;
  view.along_from = 8;
  view.along_to = 1;
  view.along_coarsest = 16;
  return {view,
          {.focus = Focus{.center = {2, 3, 0.5}, .radius = 2.5, .outside = 20},
           .along = Along{.axis = 1, .from = 8, .to = 1, .coarsest = 16}}};
}

TEST(CPlayer, GivesWhatTheCppPlayerGivesWhenLookedAt) {
  const Bytes bytes = make_stream();
  struct Case {
    std::uint32_t by;
    float amount, enough;
    std::uint32_t hold;
  };
  std::size_t largest = 0, smallest = kFinestCount;
  for (const Looks& looks : {through_a_camera(), without_a_camera()}) {
    for (const Case& c : {Case{LIMBER_BY_ERROR, 30, 0, 0}, Case{LIMBER_BY_ERROR, 60, 0, 1},
                          Case{LIMBER_BY_VERTICES, 60, 0, 0}, Case{LIMBER_BY_TRIANGLES, 90, 4, 0}}) {
      limber_cut_options options = LIMBER_CUT_DEFAULTS;
      options.by = c.by;
      options.budget = static_cast<std::uint32_t>(c.amount);
      options.error_bound = c.amount;
      options.hold = c.hold;
      options.enough = c.enough;
      options.view = &looks.view;
      const CutOptions same{.by = static_cast<CutBy>(c.by),
                            .budget = options.budget,
                            .error_bound = c.amount,
                            .hold = c.hold != 0,
                            .enough = c.enough};
      const std::vector<Drawn> expected = play_in_cpp(bytes, same, looks.same);
      SCOPED_TRACE(c.by);
      expect_frames(bytes, options, expected);
      for (const Drawn& frame : expected) {
        largest = std::max(largest, frame.nodes.size());
        smallest = std::min(smallest, frame.nodes.size());
      }
    }
  }
  EXPECT_LT(smallest, largest) << "some view changed what is drawn";
}

TEST(CPlayer, SaysHowLargeTheSeenErrorIsWhereThereIsAView) {
  const OwnedPlayer player = player_of(make_stream());
  const OwnedCut cut(limber_cut_create(player.get()));
  const Looks looks = through_a_camera();
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  options.by = LIMBER_BY_ERROR;
  options.error_bound = 60;
  options.view = &looks.view;
  limber_mesh mesh = LIMBER_MESH_INIT;
  for (const std::uint32_t hold : {0u, 1u}) {
    options.hold = hold;
    ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
    EXPECT_GT(mesh.seen_error, 0);
    EXPECT_LE(mesh.seen_error, 60);
    if (hold == 0) {
      EXPECT_LT(mesh.vertex_count, kFinestCount);
    }
  }
  options.view = nullptr;
  ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
  EXPECT_EQ(mesh.seen_error, 0);
}

TEST(CPlayer, RefusesAViewOutsideItsRangesWhereItIsLookedAt) {
  const OwnedPlayer player = player_of(make_stream());
  const OwnedCut cut(limber_cut_create(player.get()));
  const auto status_of = [&](std::uint32_t criteria, auto change) {
    limber_view view = LIMBER_VIEW_DEFAULTS;
    view.criteria = criteria;
    change(view);
    limber_cut_options options = by_vertices(60);
    options.view = &view;
    limber_mesh mesh = LIMBER_MESH_INIT;
    return limber_cut_update(cut.get(), &options, &mesh);
  };
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  using Change = void (*)(limber_view&);
  const std::pair<std::uint32_t, Change> wrong[] = {
      {LIMBER_VIEW_CAMERA, [](limber_view& view) { view.eye[1] = kNotANumber; }},
      {LIMBER_VIEW_CAMERA, [](limber_view& view) { view.target[2] = 1e30; }},
      {LIMBER_VIEW_CAMERA, [](limber_view& view) { view.fov_degrees = 0; }},
      {LIMBER_VIEW_CAMERA, [](limber_view& view) { view.fov_degrees = kNotANumber; }},
      {LIMBER_VIEW_CAMERA, [](limber_view& view) { view.height = 0; }},
      {LIMBER_VIEW_CAMERA, [](limber_view& view) { view.silhouettes = 0.5f; }},
      {LIMBER_VIEW_CAMERA, [](limber_view& view) { view.facing_away = std::numeric_limits<float>::infinity(); }},
      {LIMBER_VIEW_FOCUS, [](limber_view& view) { view.focus_radius = 0; }},
      {LIMBER_VIEW_FOCUS, [](limber_view& view) { view.focus_outside = 0; }},
      {LIMBER_VIEW_ALONG, [](limber_view& view) { view.along_axis = 3; }},
      {LIMBER_VIEW_ALONG, [](limber_view& view) { view.along_coarsest = 0; }}};
  for (const auto& [criterion, change] : wrong) {
    EXPECT_EQ(status_of(criterion, change), LIMBER_WRONG_CALL);
    EXPECT_EQ(status_of(7u & ~criterion, change), LIMBER_OK) << "it is not looked at";
  }
  EXPECT_EQ(status_of(8, [](limber_view&) {}), LIMBER_WRONG_CALL);
  EXPECT_EQ(status_of(7, [](limber_view& view) { view.struct_size = 0; }), LIMBER_WRONG_CALL);
  EXPECT_EQ(status_of(7, [](limber_view& view) { view.struct_size = offsetof(limber_view, along_coarsest); }),
            LIMBER_OK);
}

TEST(CPlayer, FetchesLevelsErrorsAndMovedVerticesWhereAsked) {
  const OwnedPlayer player = player_of(make_stream());
  const OwnedCut cut(limber_cut_create(player.get()));
  limber_cut_options options = by_vertices(60);
  limber_mesh mesh = LIMBER_MESH_INIT;
  ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
  EXPECT_EQ(mesh.levels, nullptr);
  EXPECT_EQ(mesh.errors, nullptr);
  EXPECT_EQ(mesh.moved, nullptr);
  options.fetch = LIMBER_FETCH_LEVELS | LIMBER_FETCH_ERRORS | LIMBER_FETCH_MOVED;
  std::size_t moved_count = 0;
  const limber_info info = info_of(player);
  while (limber_step(player.get()) == LIMBER_OK) {
    ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
    std::size_t moved_now = 0;
    for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
      std::uint32_t level = 0, end = info.level_size[0];
      while (mesh.nodes[v] >= end) end += info.level_size[++level];
      ASSERT_EQ(mesh.levels[v], level);
      ASSERT_GE(mesh.errors[v], 0);
      moved_now += mesh.moved[v];
    }
    EXPECT_GT(mesh.rms_error, 0);
    if (mesh.frame % test::kKeyInterval == 0) {
      EXPECT_EQ(moved_now, 0u) << "a key has no swaps";
    }
    moved_count += moved_now;
  }
  EXPECT_GT(moved_count, 0u);
}

TEST(CPlayer, MarksTheSameMovedVerticesHoweverTheFrameWasReached) {
  const OwnedPlayer stepped = player_of(make_stream()), sought = player_of(make_stream());
  const OwnedCut a(limber_cut_create(stepped.get())), b(limber_cut_create(sought.get()));
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  options.level = 1;
  options.fetch = LIMBER_FETCH_MOVED;
  for (std::uint32_t frame = 0; frame < kFrameCount; ++frame) {
    ASSERT_EQ(limber_step(stepped.get()), LIMBER_OK);
    ASSERT_EQ(limber_seek(sought.get(), (frame * 7 + 11) % kFrameCount), LIMBER_OK);
    ASSERT_EQ(limber_seek(sought.get(), frame), LIMBER_OK);
    limber_mesh one = LIMBER_MESH_INIT, other = LIMBER_MESH_INIT;
    ASSERT_EQ(limber_cut_update(a.get(), &options, &one), LIMBER_OK);
    ASSERT_EQ(limber_cut_update(b.get(), &options, &other), LIMBER_OK);
    ASSERT_EQ(std::vector(one.moved, one.moved + one.vertex_count),
              std::vector(other.moved, other.moved + other.vertex_count));
  }
}

TEST(CPlayer, BlendsChangesAsTheCppPlayerDoes) {
  const Bytes bytes = make_stream();
  const OwnedPlayer player = player_of(bytes);
  const OwnedCut cut(limber_cut_create(player.get()));
  limber_cut_options options = by_vertices(60);
  options.blend = 3;
  options.fetch = LIMBER_FETCH_LEVELS | LIMBER_FETCH_ERRORS;
  Player native;
  ASSERT_TRUE(native.open(bytes));
  ASSERT_TRUE(native.seek(0));
  const Mesh& finest = native.mesh();
  const Hierarchy& hierarchy = native.state().hierarchy;
  Cut native_cut(finest, hierarchy, {.by = CutBy::kVertices, .budget = 60, .hysteresis = options.hysteresis});
  Blend blend(finest, hierarchy, {.frames = 3});
  ExtractScratch scratch;
  MeshBuffers buffers;
  std::size_t moving_count = 0;
  for (std::uint32_t frame = 0; frame < kFrameCount; ++frame) {
    ASSERT_TRUE(native.seek(frame));
    native_cut.update(finest, native.state());
    blend.update(native.state(), native_cut);
    extract(finest, blend, scratch, buffers);
    ASSERT_EQ(limber_seek(player.get(), frame), LIMBER_OK);
    limber_mesh mesh = LIMBER_MESH_INIT;
    ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
    const Drawn got = drawn(mesh);
    EXPECT_EQ(got.positions, buffers.positions);
    EXPECT_EQ(got.normals, buffers.normals);
    EXPECT_EQ(got.indices, buffers.indices);
    EXPECT_EQ(got.nodes, buffers.nodes);
    EXPECT_TRUE(std::equal(got.labels.begin(), got.labels.end(), blend.labels().begin(), blend.labels().end()));
    for (std::size_t v = 0; v < got.nodes.size(); ++v) {
      const bool moves = got.nodes[v] >= hierarchy.node_count();
      const Index node = moves ? blend.target(got.nodes[v] - hierarchy.node_count()) : got.nodes[v];
      EXPECT_EQ(mesh.levels[v], hierarchy.level_of(node));
      moving_count += moves;
    }
  }
  EXPECT_GT(moving_count, 0u);
}

TEST(CPlayer, ShowsChangesAtOnceWhereNotAskedToBlendThem) {
  const OwnedPlayer player = player_of(make_stream());
  const OwnedCut cut(limber_cut_create(player.get())), other(limber_cut_create(player.get()));
  limber_cut_options options = by_vertices(60), blended = options;
  for (std::uint32_t frame = 0; frame < kFrameCount; ++frame) {
    ASSERT_EQ(limber_seek(player.get(), frame), LIMBER_OK);
    limber_mesh mesh = LIMBER_MESH_INIT, same = LIMBER_MESH_INIT;
    blended.blend = frame < 6 ? 4 : frame % 2;  // what was on its way is dropped
    ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
    ASSERT_EQ(limber_cut_update(other.get(), &blended, &same), LIMBER_OK);
    if (frame == 0 || frame >= 6) {
      EXPECT_EQ(drawn(mesh), drawn(same)) << frame;
    }
  }
}

TEST(CPlayer, DoesNotAllocateOncePlayedThrough) {
  const OwnedPlayer player = player_of(make_stream());
  const OwnedCut cut(limber_cut_create(player.get()));
  limber_cut_options options = by_vertices(60);
  options.fetch = LIMBER_FETCH_LEVELS | LIMBER_FETCH_ERRORS | LIMBER_FETCH_MOVED;
  const OwnedCut looked_at(limber_cut_create(player.get()));
  Looks looks = through_a_camera();
  limber_cut_options seen = LIMBER_CUT_DEFAULTS;
  seen.by = LIMBER_BY_ERROR;
  seen.error_bound = 30;
  seen.view = &looks.view;
  const OwnedCut blended(limber_cut_create(player.get()));
  limber_cut_options blend = options;
  blend.blend = 4;
  const auto play = [&] {
    for (std::uint32_t frame = 0; frame < kFrameCount; ++frame) {
      limber_mesh mesh = LIMBER_MESH_INIT;
      ASSERT_EQ(limber_seek(player.get(), frame), LIMBER_OK);
      ASSERT_EQ(limber_cut_update(cut.get(), &options, &mesh), LIMBER_OK);
      looks.view.eye[0] = 4 + 0.1 * frame;
      ASSERT_EQ(limber_cut_update(looked_at.get(), &seen, &mesh), LIMBER_OK);
      ASSERT_EQ(limber_cut_update(blended.get(), &blend, &mesh), LIMBER_OK);
    }
  };
  play();
  play();  // from here on each begins with what the last frame's hysteresis left
  const std::size_t before = test::allocation_count();
  play();
  EXPECT_EQ(test::allocation_count(), before);
}

}  // namespace
}  // namespace limber
