// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/front.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

#include "limber/fourface/build_four_k.h"
#include "limber/fourface/criteria.h"
#include "tests/support/shapes.h"
#include "tests/support/topology.h"

namespace limber {
namespace {

using test::Shape;

std::vector<Index> numbers(const Front& front) {
  std::vector<Index> sorted(front.triangles().begin(), front.triangles().end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

struct Built {
  explicit Built(Shape s) : shape(std::move(s)), mesh(build_four_k(shape.mesh, shape.positions, {})) {}

  double error(Index o) const { return static_cast<double>(mesh.error[o]); }
  // By an error threshold and the operations, with no front.
  std::vector<Index> left_by(double threshold) const {
    std::vector<Index> left;
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const Index c = mesh.creator[t], d = mesh.destroyer[t];
      if ((c == kNone || error(c) <= threshold) && (d == kNone || error(d) > threshold)) left.push_back(t);
    }
    return left;
  }

  Shape shape;
  FourKMesh mesh;
};

TEST(Front, BeginsAtTheCoarsestMeshAndReachesTheFinest) {
  const Built built(test::sphere(3));
  Front front(built.mesh);
  EXPECT_EQ(front.triangles().size(), triangles_after(built.mesh, built.mesh.operation_count()).size());
  front.move([](Index) { return false; });
  EXPECT_EQ(front.triangles().size(), built.mesh.finest_count);
  EXPECT_EQ(front.changes(), built.mesh.operation_count());
  front.move([](Index) { return true; });
  EXPECT_EQ(front.changes(), built.mesh.operation_count());
  front.move([](Index) { return true; });
  EXPECT_EQ(front.changes(), 0u);
}

TEST(Front, HoldsWhatTheCriterionSaysWhereverItComesFrom) {
  const Built built(test::waved(test::sheet(25, 25)));
  Front front(built.mesh);
  for (const double threshold : {0.1, 0.01, 0.5, 0.0, 0.03, 10.0, 0.001}) {
    front.move([&](Index o) { return built.error(o) <= threshold; });
    EXPECT_EQ(numbers(front), built.left_by(threshold)) << threshold;
  }
}

TEST(Front, ListsTheCornersOfItsTriangles) {
  const Built built(test::sphere(2));
  Front front(built.mesh);
  std::vector<Triangle> corners;
  front.list(corners);
  ASSERT_EQ(corners.size(), front.triangles().size());
  for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_EQ(corners[i], built.mesh.triangles[front.triangles()[i]]);
}

TEST(Front, UsesABudgetUpWithTheFewestOperations) {
  const Built built(test::waved(test::sheet(25, 25)));
  std::vector<Index> order(built.mesh.operation_count());
  for (Index o = 0; o < order.size(); ++o) order[o] = o;
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return built.mesh.error[a] < built.mesh.error[b]; });
  Front front(built.mesh);
  for (const Index budget : {300u, 310u, 200u, 1100u, 50u, 2000u, 1u, 400u}) {
    front.move_to_budget([&](Index o) { return built.error(o); }, budget);
    // The order's prefix, one operation after the other.
    std::vector<bool> applied(built.mesh.operation_count(), false);
    Index count = built.mesh.finest_count;
    for (std::size_t i = 0; i < order.size() && count > budget; ++i) {
      applied[order[i]] = true;
      count -= static_cast<Index>(built.mesh.destroyed_by(order[i]).size()) - built.mesh.created_count(order[i]);
    }
    std::vector<Index> expected;
    for (Index t = 0; t < built.mesh.triangle_count(); ++t) {
      const Index c = built.mesh.creator[t], d = built.mesh.destroyer[t];
      if ((c == kNone || applied[c]) && (d == kNone || !applied[d])) expected.push_back(t);
    }
    EXPECT_EQ(numbers(front), expected) << budget;
  }
}

TEST(Front, IsFineInARegionAndCoarseBeyond) {
  const Built built(test::waved(test::sheet(40, 40)));
  Front front(built.mesh);
  const Vec3d center{10, 10, 0};
  front.move([&](Index o) { return distance_to(built.mesh, built.shape.positions, o, center) > 5; });
  std::vector<Triangle> corners;
  front.list(corners);
  std::size_t inside = 0;
  for (const Triangle& t : corners) inside += length(static_cast<Vec3d>(built.shape.positions[t[0]]) - center) < 5;
  EXPECT_LT(corners.size(), built.mesh.finest_count / 2);
  std::size_t finest_inside = 0;
  for (Index t = 0; t < built.mesh.finest_count; ++t)
    finest_inside += length(static_cast<Vec3d>(built.shape.positions[built.mesh.triangles[t][0]]) - center) < 5;
  EXPECT_EQ(inside, finest_inside);
}

// What a thousand random criteria, most of them small steps from the one before, may not do.
void expect_sound_fronts(const Built& built, int count, bool height_field) {
  const std::span<const Vec3f> positions = built.shape.positions;
  const test::Invariants finest = test::invariants_of(triangles_after(built.mesh, 0));
  test::Random random(7);
  const float largest = *std::max_element(built.mesh.error.begin(), built.mesh.error.end());
  Front front(built.mesh);
  Vec3d eye{1, 2, 3};
  double threshold = 0.1, radius = 1;
  Index budget = built.mesh.finest_count / 2;
  int kind = 0;
  std::vector<Triangle> corners;
  for (int i = 0; i < count; ++i) {
    if (i % 10 == 0) {
      kind = static_cast<int>(random.below(4));
      eye = static_cast<Vec3d>(positions[random.below(built.mesh.vertex_count)]) +
            static_cast<Vec3d>(random.point()) * 3.0;
      threshold = static_cast<double>(largest) * std::pow(2.0, -static_cast<double>(random.below(12)));
      radius = 0.2 + random.below(8);
      budget = 20 + random.below(built.mesh.finest_count);
    } else {
      eye += static_cast<Vec3d>(random.point()) * 0.2;
      threshold *= 1 + 0.1 * static_cast<double>(random.unit());
      budget = budget * (90 + random.below(21)) / 100;
    }
    const HalfSpace half{{1, 0, 0}, eye.x - 2};
    const auto value = [&](Index o) {
      if (kind == 0) return built.error(o);
      if (kind == 1) return error_in_ball(built.mesh, positions, o, eye, radius);
      return seen_error(built.mesh, positions, o, eye, {&half, 1});
    };
    Front scratch(built.mesh);
    if (kind == 3) {
      front.move_to_budget(value, budget);
      scratch.move([](Index) { return false; });
      scratch.move_to_budget(value, budget);
    } else {
      front.move([&](Index o) { return value(o) <= threshold; });
      scratch.move([&](Index o) { return value(o) <= threshold; });
    }
    ASSERT_EQ(numbers(front), numbers(scratch)) << i;
    front.list(corners);
    ASSERT_TRUE(test::same_shape(test::invariants_of(corners), finest)) << i;
    if (!height_field) continue;
    for (const auto& [a, b, c] : corners)
      ASSERT_GT(cross(positions[b] - positions[a], positions[c] - positions[a]).z, 0) << i;
  }
}

TEST(Front, IsConformingAndTheSameFromScratchFor500RandomCriteriaOnAHeightField) {
  const Shape low = test::moved(test::waved(test::sheet(20, 20)), [](Vec3f p) { return Vec3f{p.x, p.y, 0.3f * p.z}; });
  expect_sound_fronts(Built(low), 500, true);
}

TEST(Front, IsConformingAndTheSameFromScratchFor500RandomCriteriaOnATorus) {
  expect_sound_fronts(Built(test::jittered(test::torus(16, 28), 0.05f, 6)), 500, false);
}

}  // namespace
}  // namespace limber
