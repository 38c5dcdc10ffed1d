// SPDX-License-Identifier: Apache-2.0
// What a cut does with a view (cut_of_view.cpp).
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "limber/view/cut.h"
#include "limber/view/triangle_distance.h"
#include "limber/view/triangle_list.h"
#include "tests/view/allocations.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

using test::Surface;

// Of the torus, whose outer radius is 4.
View view_from(const Vec3d& eye, const Vec3d& target = {}, double fov = 40) {
  return {
      .camera = Camera{.eye = eye, .target = target, .up = {0, 0, 1}, .fov_degrees = fov}, .width = 800, .height = 600};
}

struct Scene {
  Surface surface = test::torus(40, 60);
  FrameState state = test::patch_state(surface, {2400, 600, 150, 40, 10});
};

// Pixels of a length of 1 at a place in the picture; 0 outside.
double pixels_at(const View& view, const Vec3d& place) {
  const CameraAxes axes = camera_axes(*view.camera);
  const Vec3d q = place - view.camera->eye;
  const double depth = -dot(q, axes.back), slope = tangent_of_half(view.camera->fov_degrees);
  const double aspect = static_cast<double>(view.width) / view.height;
  if (depth <= 0 || std::abs(dot(q, axes.up)) > slope * depth || std::abs(dot(q, axes.right)) > slope * aspect * depth)
    return 0;
  return view.height / (2 * slope * depth);
}

double distance_to(const Vec3f& p, std::span<const Triangle> triangles, std::span<const Vec3f> positions) {
  float least = std::numeric_limits<float>::infinity();
  for (const Triangle& t : triangles)
    least = std::min(least, squared_distance_to_triangle(p, positions[t[0]], positions[t[1]], positions[t[2]]));
  return std::sqrt(double{least});
}

Index active_count(const Cut& cut, const FrameState& state, bool (*is_in)(const Vec3f&)) {
  Index count = 0;
  for (Index n = 0; n < cut.labels().size(); ++n) count += cut.is_active(n) && is_in(state.positions[n]);
  return count;
}

TEST(CutOfView, HoldsWhatIsSeenWithinThePixelsInBothDirections) {
  Scene scene;
  const auto& [surface, state] = scene;
  Cut cut(surface.mesh, state.hierarchy, {.by = CutBy::kError});
  test::Random random(1);
  TriangleList list;
  int coarser = 0;
  for (int round = 0; round < 12; ++round) {
    const auto coordinate = [&] { return 16.0 * double{random.unit()} - 8.0; };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    const View view = view_from({x, y, 9 + z}, {x / 4, y / 4, 0});
    const float pixels = 1 + 7 * random.unit();
    cut.set_options({.by = CutBy::kError, .error_bound = pixels});
    cut.update(surface.mesh, state, view);
    EXPECT_LE(cut.seen_error(), pixels);
    list_triangles(surface.mesh, cut.labels(), list);
    coarser += list.triangles.size() < surface.mesh.triangles.size();
    for (Index v = 0; v < surface.mesh.vertex_count; ++v) {
      const double scale = pixels_at(view, Vec3d(state.positions[v]));
      if (scale == 0 || cut.is_active(v)) continue;
      ASSERT_LE(scale * distance_to(state.positions[v], list.triangles, state.positions), pixels) << v;
    }
    for (Index n = surface.mesh.vertex_count; n < state.hierarchy.node_count(); ++n) {
      const double scale = pixels_at(view, Vec3d(state.positions[n]));
      if (scale == 0 || !cut.is_active(n)) continue;
      ASSERT_LE(scale * distance_to(state.positions[n], surface.mesh.triangles, state.positions), pixels) << n;
    }
    test::deform(surface.mesh, scene.state, 40, random);
  }
  EXPECT_GT(coarser, 3);
}

TEST(CutOfView, HasOneActiveNodeOnEveryPathWhateverTheOptions) {
  Scene scene;
  const auto& [surface, state] = scene;
  test::Random random(2);
  for (const CutOptions& options :
       {CutOptions{.by = CutBy::kError, .error_bound = 2},
        CutOptions{.by = CutBy::kError, .error_bound = 2, .hold = false},
        CutOptions{.by = CutBy::kVertices, .budget = 300}, CutOptions{.by = CutBy::kTriangles, .budget = 300},
        CutOptions{.by = CutBy::kLevel, .level = 2}}) {
    Cut cut(surface.mesh, state.hierarchy, options);
    for (int frame = 0; frame < 10; ++frame) {
      cut.update(surface.mesh, state, view_from({9.0 - frame, 1.0 * frame, 5}));
      for (Index v = 0; v < surface.mesh.vertex_count; ++v) {
        Index active = 0;
        for (Index n = v; n != kNone; n = state.hierarchy.parent[n]) {
          active += cut.is_active(n);
          ASSERT_EQ(cut.labels()[n] == kNone, active == 0 ? false : !cut.is_active(n) && cut.is_expanded(n));
        }
        ASSERT_EQ(active, 1u);
      }
      if (options.by == CutBy::kVertices) {
        EXPECT_LE(cut.vertex_count(), options.budget);
      }
      test::deform(surface.mesh, scene.state, 40, random);
    }
  }
}

TEST(CutOfView, IsTheFinestLevelWhereTheEyeIsCloseEnough) {
  Scene scene;
  const auto& [surface, state] = scene;
  Cut cut(surface.mesh, state.hierarchy, {.by = CutBy::kError, .error_bound = 1e-4f});
  cut.update(surface.mesh, state, view_from({12, 0, 0}));
  EXPECT_EQ(cut.vertex_count(), surface.mesh.vertex_count);
  EXPECT_LE(cut.seen_error(), 1e-4f);
}

TEST(CutOfView, IsFinerWhereItIsNearer) {
  const Scene scene;
  Cut cut(scene.surface.mesh, scene.state.hierarchy, {.by = CutBy::kVertices, .budget = 600, .hysteresis = 1});
  cut.update(scene.surface.mesh, scene.state, view_from({5.5, 0, 0}, {0, 0, 0}, 100));
  EXPECT_GT(active_count(cut, scene.state, [](const Vec3f& p) { return p.x > 2; }),
            2 * active_count(cut, scene.state, [](const Vec3f& p) { return p.x < -2; }));
}

TEST(CutOfView, IsCoarserOutsideThePicture) {
  const Scene scene;
  Cut cut(scene.surface.mesh, scene.state.hierarchy, {.by = CutBy::kError, .error_bound = 1});
  cut.update(scene.surface.mesh, scene.state, view_from({0, 0, 12}, {0, 0, 0}, 60));
  const Index whole = active_count(cut, scene.state, [](const Vec3f& p) { return p.x < -1; });
  cut.update(scene.surface.mesh, scene.state, view_from({4, 0, 12}, {4, 0, 0}, 10));
  const Index outside = active_count(cut, scene.state, [](const Vec3f& p) { return p.x < -1; });
  EXPECT_LT(2 * outside, whole);
}

TEST(CutOfView, IsCoarserWhereTheSurfaceFacesAway) {
  const Scene scene;
  View view = view_from({0, 0, 12});
  const auto below = [](const Vec3f& p) { return p.z < -0.5f; };
  Cut cut(scene.surface.mesh, scene.state.hierarchy,
          {.by = CutBy::kError, .error_bound = 1, .hysteresis = 1, .hold = false});
  cut.update(scene.surface.mesh, scene.state, view);
  const Index everywhere = active_count(cut, scene.state, below);
  view.facing_away = 20;
  cut.update(scene.surface.mesh, scene.state, view);
  EXPECT_LT(2 * active_count(cut, scene.state, below), everywhere);
}

TEST(CutOfView, IsFinerInsideAFocus) {
  const Scene scene;
  Cut cut(scene.surface.mesh, scene.state.hierarchy, {.by = CutBy::kVertices, .budget = 500, .hysteresis = 1});
  cut.update(scene.surface.mesh, scene.state, {.focus = Focus{.center = {3, 0, 0}, .radius = 1.5, .outside = 100}});
  EXPECT_LE(cut.vertex_count(), 500u);
  EXPECT_GT(active_count(cut, scene.state, [](const Vec3f& p) { return p.x > 2; }),
            4 * active_count(cut, scene.state, [](const Vec3f& p) { return p.x < -2; }));
}

TEST(CutOfView, GrowsCoarserAlongAnAxis) {
  const Scene scene;
  Cut cut(scene.surface.mesh, scene.state.hierarchy, {.by = CutBy::kTriangles, .budget = 1000, .hysteresis = 1});
  cut.update(scene.surface.mesh, scene.state, {.along = Along{.axis = 1, .from = 4, .to = -4}});
  const Index fine = active_count(cut, scene.state, [](const Vec3f& p) { return p.y > 2; });
  const Index between = active_count(cut, scene.state, [](const Vec3f& p) { return std::abs(p.y) < 1; });
  const Index coarse = active_count(cut, scene.state, [](const Vec3f& p) { return p.y < -2; });
  EXPECT_GT(fine, between);
  EXPECT_GT(fine, 4 * coarse);
}

TEST(CutOfView, WithoutACameraErrorsAreInPercentOfTheDiagonal) {
  const Scene scene;
  Cut cut(scene.surface.mesh, scene.state.hierarchy, {.by = CutBy::kError, .error_bound = 1});
  cut.update(scene.surface.mesh, scene.state, View{});
  TriangleList list;
  list_triangles(scene.surface.mesh, cut.labels(), list);
  Box box;
  for (const Vec3f& p : scene.surface.positions) box.add(Vec3d(p));
  double largest = 0;
  for (const Vec3f& p : scene.surface.positions)
    largest = std::max(largest, distance_to(p, list.triangles, scene.state.positions));
  EXPECT_LE(100 * largest / box.diagonal(), 1);
  EXPECT_GT(100 * largest / box.diagonal(), 0.1);
}

TEST(CutOfView, SpendsNoBudgetBelowWhatIsEnough) {
  const Scene scene;
  const View view = view_from({0, 0, 12});
  Cut cut(scene.surface.mesh, scene.state.hierarchy, {.by = CutBy::kVertices, .budget = 2000, .hysteresis = 1});
  cut.update(scene.surface.mesh, scene.state, view);
  const Index all = cut.vertex_count();
  cut.set_options({.by = CutBy::kVertices, .budget = 2000, .hysteresis = 1, .enough = 40});
  cut.update(scene.surface.mesh, scene.state, view);
  EXPECT_GT(all, 1900u);
  EXPECT_LT(cut.vertex_count(), all / 2);
}

TEST(CutOfView, WithHysteresisASlowCameraChangesLess) {
  const Scene scene;
  std::size_t changes[2] = {0, 0};
  for (int i = 0; i < 2; ++i) {
    Cut cut(scene.surface.mesh, scene.state.hierarchy,
            {.by = CutBy::kError, .error_bound = 20, .hysteresis = i == 0 ? 1.0f : 1.5f, .hold = false});
    std::vector<Index> before;
    for (int step = 0; step < 40; ++step) {  // to and fro
      const double sway = 0.05 * std::sin(step);
      cut.update(scene.surface.mesh, scene.state, view_from(Vec3d{9, 0, 3} * (1 + sway)));
      for (std::size_t n = 0; n < before.size(); ++n) changes[i] += before[n] != cut.labels()[n];
      before.assign(cut.labels().begin(), cut.labels().end());
    }
  }
  EXPECT_GT(changes[0], 0u);
  EXPECT_LT(4 * changes[1], changes[0]);
}

TEST(CutOfView, DoesNotAllocateAfterTheFirstUpdate) {
  Scene scene;
  const auto& [surface, state] = scene;
  test::Random random(5);
  for (const CutOptions& options :
       {CutOptions{.by = CutBy::kError, .error_bound = 2},
        CutOptions{.by = CutBy::kError, .error_bound = 2, .hold = false},
        CutOptions{.by = CutBy::kVertices, .budget = 300}, CutOptions{.by = CutBy::kTriangles, .budget = 300}}) {
    Cut cut(surface.mesh, state.hierarchy, options);
    View view = view_from({9, 0, 5});
    view.facing_away = view.silhouettes = 2;
    view.focus = Focus{};
    cut.update(surface.mesh, state, view);
    for (int frame = 0; frame < 10; ++frame) {
      const std::size_t before = test::allocation_count();
      view.camera->eye.y += 0.3;
      cut.update(surface.mesh, state, view);
      EXPECT_EQ(test::allocation_count(), before);
      test::deform(surface.mesh, scene.state, 40, random);
    }
  }
}

TEST(CutOfView, OfAHierarchyOfOneLevelIsThatLevel) {
  const Surface surface = test::sheet(5, 5);
  const FrameState state = test::patch_state(surface, {25});
  for (const CutBy by : {CutBy::kLevel, CutBy::kVertices, CutBy::kTriangles, CutBy::kError}) {
    Cut cut(surface.mesh, state.hierarchy, {.by = by, .budget = 2, .error_bound = 5});
    cut.update(surface.mesh, state, view_from({9, 0, 5}));
    EXPECT_EQ(cut.vertex_count(), 25u);
    EXPECT_NEAR(cut.seen_error(), 0, 1e-3);
  }
}

}  // namespace
}  // namespace limber
