// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/turns.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace limber {
namespace {

// Vertices in nodes of `group` each, those in a top node; the order of the traversal is that of the numbers.
struct Scene {
  std::vector<Index> level_begin;
  std::vector<Index> parent;
  Traversal traversal;
  std::vector<Lattice> before, now;

  Scene(Index vertex_count, Index group) {
    const Index node_count = (vertex_count + group - 1) / group;
    level_begin = {0, vertex_count, vertex_count + node_count, vertex_count + node_count + 1};
    for (Index v = 0; v < vertex_count; ++v) parent.push_back(vertex_count + v / group);
    for (Index n = 0; n < node_count; ++n) parent.push_back(vertex_count + node_count);
    parent.push_back(kNone);
    for (Index v = 0; v < vertex_count; ++v) traversal.order.push_back(v);
  }

  void move(const std::function<Vec3d(Index)>& from, const std::function<Vec3d(const Vec3d&)>& motion) {
    const auto rounded = [](const Vec3d& p) {
      return Lattice{static_cast<std::int32_t>(std::lround(p.x)), static_cast<std::int32_t>(std::lround(p.y)),
                     static_cast<std::int32_t>(std::lround(p.z))};
    };
    for (Index v = 0; v < level_begin[1]; ++v) {
      before.push_back(rounded(from(v)));
      now.push_back(rounded(motion(from(v))));
    }
  }

  // A vector that turns with the n-th node above the finest level.
  Vec3d turned(Index n, const Vec3d& v) const {
    Turns turns(level_begin);
    turns.measure(parent, traversal, before, now);
    return turns.turned(parent, level_begin[1] + n, v);
  }

  Index top() const { return level_begin[2] - level_begin[1]; }
};

Vec3d on_a_sheet(Index v) { return {100.0 * (v % 5) + 7000, 100.0 * (v / 5 % 5), 30.0 * (v % 3)}; }

// Around the z axis by an angle given in degrees, then elsewhere.
std::function<Vec3d(const Vec3d&)> rotation(double degrees) {
  const double c = std::cos(degrees * 0.017453292519943295), s = std::sin(degrees * 0.017453292519943295);
  return [=](const Vec3d& p) { return Vec3d{c * p.x - s * p.y + 500, s * p.x + c * p.y - 900, p.z + 40}; };
}

void expect_near(const Vec3d& a, const Vec3d& b, double distance) {
  EXPECT_LE(length(a - b), distance) << a.x << " " << a.y << " " << a.z;
}

TEST(Turns, FindsARotationOfALargeCluster) {
  for (const double degrees : {-40.0, -5.0, 0.0, 12.0, 70.0}) {
    Scene scene(25, 25);
    scene.move(on_a_sheet, rotation(degrees));
    const auto turn = rotation(degrees);
    const Vec3d v{300, 200, 100};
    // The ridge takes a little of the angle away.
    expect_near(scene.turned(0, v), turn(v) - turn({}), 0.05 * std::fabs(degrees) / 10 * length(v));
  }
}

TEST(Turns, KeepLengths) {
  Scene scene(25, 25);
  scene.move(on_a_sheet, rotation(33));
  EXPECT_NEAR(length(scene.turned(0, {30, 40, 120})), 130, 1e-9);
}

TEST(Turns, OfASmallClusterAreThoseOfItsParent) {
  for (const Index size : {2u, 5u}) {
    Scene scene(25, size);
    scene.move(on_a_sheet, rotation(20));
    // One that moves by itself, which its cluster does not heed.
    scene.now[0] = {scene.now[0][0], scene.now[0][1] + 60, scene.now[0][2]};
    const Vec3d v{100, 0, 50};
    for (Index node = 0; node < scene.top(); ++node) EXPECT_EQ(scene.turned(node, v), scene.turned(scene.top(), v));
    EXPECT_GT(length(scene.turned(scene.top(), v) - v), 20);
  }
}

TEST(Turns, OfALargeClusterAreItsOwn) {
  Scene scene(50, 25);
  scene.move([](Index v) { return on_a_sheet(v % 25); }, rotation(20));
  for (Index v = 25; v < 50; ++v) scene.now[v] = scene.before[v];
  const Vec3d v{100, 0, 50};
  EXPECT_GT(length(scene.turned(0, v) - v), 20);
  EXPECT_EQ(scene.turned(1, v), v);
}

TEST(Turns, AreNoneWhereAllStays) {
  Scene scene(25, 5);
  scene.move(on_a_sheet, [](const Vec3d& p) { return p; });
  EXPECT_EQ(scene.turned(0, {1, 2, 3}), (Vec3d{1, 2, 3}));
}

TEST(Turns, AreNoneWhereAllVerticesAreInOnePlace) {
  Scene scene(9, 3);
  scene.move([](Index) { return Vec3d{5, 5, 5}; }, rotation(30));
  EXPECT_EQ(scene.turned(0, {1, 2, 3}), (Vec3d{1, 2, 3}));
}

TEST(Turns, StayFiniteAtTheEndsOfTheLattice) {
  Scene scene(9, 9);
  constexpr auto kLow = std::numeric_limits<std::int32_t>::min(), kHigh = std::numeric_limits<std::int32_t>::max();
  for (Index v = 0; v < 9; ++v) {
    scene.before.push_back({v % 2 ? kLow : kHigh, v % 3 ? kHigh : kLow, kLow});
    scene.now.push_back({v % 3 ? kHigh : kLow, v % 2 ? kLow : kHigh, v % 4 ? kHigh : kLow});
  }
  const Vec3d turned = scene.turned(0, {1e9, -1e9, 1e9});
  EXPECT_TRUE(is_finite(turned));
  EXPECT_LE(length(turned), 1.8e9);
}

}  // namespace
}  // namespace limber
