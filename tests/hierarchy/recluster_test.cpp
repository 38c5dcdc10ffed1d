// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/recluster.h"

#include <gtest/gtest.h>
#include <set>
#include <type_traits>

#include "limber/base/facing.h"
#include "limber/hierarchy/validate.h"
#include "tests/support/hierarchies.h"

namespace limber {
namespace {

using test::Shape;

std::vector<Swap> stepped(Reclusterer& r, const std::vector<Vec3f>& positions) {
  const auto swaps = r.step(positions);
  return {swaps.begin(), swaps.end()};
}

// Bends and stretches a shape more and more.
Shape deformed(const Shape& shape, int frame) {
  const float t = 0.15f * static_cast<float>(frame);
  return moved(shape, [t](Vec3f p) {
    const float bend = t * p.z;
    return Vec3f{p.x * std::cos(bend) - p.y * std::sin(bend), p.x * std::sin(bend) + p.y * std::cos(bend),
                 p.z * (1 + t * 0.3f) + 0.3f * std::sin(3 * p.x + t)};
  });
}

// The errors of all levels under a hierarchy, in normalized units, summed without the reclusterer.
std::vector<double> level_errors(const Shape& shape, const Hierarchy& h, double scale) {
  const Vec3d center = normalization(shape.positions).center;
  std::vector<Vec3d> unit;
  for (const Vec3f& p : shape.positions) unit.push_back((static_cast<Vec3d>(p) - center) * scale);
  std::vector<Quadric> quadrics(h.node_count());
  VertexQuadrics(shape.mesh, {}).compute(unit, std::span(quadrics).first(h.vertex_count()));
  for (Index node = 0; node < h.node_count(); ++node)
    if (h.parent[node] != kNone) quadrics[h.parent[node]] += quadrics[node];
  std::vector<double> errors(h.level_count(), 0.0);
  for (Index level = 1; level < h.level_count(); ++level)
    for (Index node = h.level_begin[level]; node < h.level_begin[level + 1]; ++node)
      errors[level] += minimum(quadrics[node]).value;
  return errors;
}

double weighted(const std::vector<double>& errors, const Hierarchy& h, double growth, double coarser_weight) {
  double sum = 0, weight = 1;
  for (Index level = 1; level < h.level_count(); ++level) {
    if (level > 1)
      weight *= coarser_weight * std::pow(static_cast<double>(h.level_size(level)) / h.level_size(level - 1), growth);
    sum += weight * errors[level];
  }
  return sum;
}

TEST(Reclusterer, CannotBeCopiedAwayFromWhatItsPartsReferTo) {
  EXPECT_FALSE(std::is_copy_constructible_v<Reclusterer>);
  EXPECT_FALSE(std::is_copy_assignable_v<Reclusterer>);
}

// Six vertices in two clusters:   1 - 3 - 5
//                                 | \ | \ |
//                                 0 - 2 - 4
TEST(Reclusterer, MakesOneSwapWhenOneVertexWalksOver) {
  const Mesh strip{6, {{0, 2, 1}, {1, 2, 3}, {2, 4, 3}, {3, 4, 5}}};
  std::vector<Vec3f> positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {9, 1, 0}, {10, 0, 0}, {10, 1, 0}};
  const Hierarchy base{{0, 6, 8}, {6, 6, 6, 7, 7, 7, kNone, kNone}};
  // In the plane, and without its border planes, a strip is nothing but its points.
  Reclusterer r(strip, base, {.topology = Topology::kFree, .quadrics = {.border_weight = 0}, .growth = {}});
  EXPECT_TRUE(stepped(r, positions).empty());
  positions[2].x = 9;
  EXPECT_EQ(stepped(r, positions), (std::vector<Swap>{{2, 7}}));
  EXPECT_TRUE(stepped(r, positions).empty());
  positions[2].x = 1;
  EXPECT_EQ(stepped(r, positions), (std::vector<Swap>{{2, 6}}));
}

TEST(Reclusterer, MakesNoSwapForARepeatedFrameOnceWhatFinerLevelsOpenedIsTaken) {
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    const Shape shape = test::jittered(test::sphere(4), 0.02f, 1);
    Reclusterer r(shape.mesh, test::built(shape, 8, topology), {.topology = topology, .quadrics = {}, .growth = {}});
    std::size_t late = 0;
    for (int frame = 0; frame < 4; ++frame) {
      const Shape now = deformed(shape, frame);
      stepped(r, now.positions);
      late += stepped(r, now.positions).size();
      EXPECT_TRUE(stepped(r, now.positions).empty()) << frame;
      EXPECT_TRUE(stepped(r, now.positions).empty()) << frame;
    }
    EXPECT_LE(late, 4u);  // a level is not looked at again after the finer ones, within a step
  }
}

TEST(Reclusterer, MakesAlmostNoSwapsForARigidMotion) {
  const Shape shape = test::jittered(test::sphere(4), 0.02f, 2);
  Reclusterer r(shape.mesh, test::built(shape, 8, Topology::kPreserve), {});
  stepped(r, shape.positions);
  std::size_t swap_count = 0;
  for (int frame = 1; frame < 10; ++frame) {
    const float turn = 0.4f * static_cast<float>(frame);
    const Shape now = moved(shape, [turn, frame](Vec3f p) {
      return Vec3f{p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn), p.z} +
             Vec3f{0.5f, -0.25f, 1} * static_cast<float>(frame);
    });
    swap_count += stepped(r, now.positions).size();
  }
  EXPECT_LE(swap_count, 3u);
}

TEST(Reclusterer, ImprovesTheBaseInTheFirstStep) {
  const Shape shape = test::jittered(test::sphere(4), 0.02f, 3);
  const Hierarchy base = test::built(shape, 8, Topology::kPreserve);
  Reclusterer r(shape.mesh, base, {});
  EXPECT_GT(stepped(r, shape.positions).size(), 10u);
  const std::vector<double> before = level_errors(shape, base, normalization(shape.positions).scale);
  for (Index level = 1; level < base.level_count(); ++level) EXPECT_LT(r.total_error(level), 0.95 * before[level]);
}

TEST(Reclusterer, NeverRaisesTheWeightedErrorInAStep) {
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    for (const Shape& shape : {test::jittered(test::sphere(4), 0.02f, 4), test::waved(test::sheet(30, 25)),
                               test::jittered(test::torus(12, 40), 0.02f, 5)}) {
      const ReclusterOptions options{.topology = topology, .quadrics = {}, .growth = {}};
      Reclusterer r(shape.mesh, test::built(shape, 5, topology), options);
      const double scale = normalization(deformed(shape, 0).positions).scale;
      for (int frame = 0; frame < 8; ++frame) {
        const Shape now = deformed(shape, frame);
        const Hierarchy last = r.hierarchy();
        const bool any = !stepped(r, now.positions).empty();
        const double before = weighted(level_errors(now, last, scale), last, r.growth(), options.coarser_weight);
        const std::vector<double> errors = level_errors(now, r.hierarchy(), scale);
        const double after = weighted(errors, last, r.growth(), options.coarser_weight);
        EXPECT_TRUE(any ? after < before : after == before) << frame << ": " << before << " to " << after;
        for (Index level = 1; level < last.level_count(); ++level)
          EXPECT_NEAR(r.total_error(level), errors[level], 1e-9 * errors[level]);
      }
    }
  }
}

TEST(Reclusterer, ReportsSwapsThatReplayToTheSameHierarchyInTheOrderOfTheNodes) {
  const Shape shape = test::jittered(test::sphere(4), 0.02f, 6);
  Hierarchy replayed = test::built(shape, 4, Topology::kPreserve);
  Reclusterer r(shape.mesh, replayed, {});
  for (int frame = 0; frame < 8; ++frame) {
    const std::vector<Swap> swaps = stepped(r, deformed(shape, frame).positions);
    EXPECT_GT(swaps.size(), 0u);
    for (std::size_t i = 0; i < swaps.size(); ++i) {
      EXPECT_TRUE(i == 0 || swaps[i - 1].node < swaps[i].node);
      EXPECT_NE(replayed.parent[swaps[i].node], swaps[i].parent) << "nothing changes";
      apply(replayed, swaps[i]);
    }
    ASSERT_EQ(replayed, r.hierarchy());
  }
}

TEST(Reclusterer, KeepsEveryInvariantOnSmallShapes) {
  const Shape shapes[] = {test::torus(9, 24), test::waved(test::sheet_with_hole(18, 18)), test::sphere(3),
                          test::together(test::sphere(2), test::waved(test::sheet(9, 9)), 4)};
  for (const Shape& shape : shapes) {
    for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
      Validator validator(shape.mesh, topology);
      Reclusterer r(shape.mesh, test::built(shape, 3, topology),
                    {.topology = topology, .quadrics = {}, .growth = {}, .coarser_weight = 1, .threshold = 0});
      for (int frame = 0; frame < 12; ++frame) {
        stepped(r, test::jittered(deformed(shape, frame), 0.05f, 7).positions);
        const auto violation = validator(r.hierarchy());
        ASSERT_FALSE(violation) << "frame " << frame << ": " << violation->line();
      }
    }
  }
}

// Folds along y in scene 0, along x in scene 1, and hardly moves within one.
Shape scene(const Shape& shape, int number, int frame) {
  return moved(shape, [number, frame](Vec3f p) {
    const float across = number == 0 ? p.x : p.y;
    return p + Vec3f{0, 0, 3 * std::sin(across + 0.01f * static_cast<float>(frame))};
  });
}

TEST(Reclusterer, BeginsAnewWhereTheClipJumpsAsWellAsABaseOfThatFrameWould) {
  const Shape flat = test::jittered(test::sheet(40, 40), 0.1f, 13);
  const Shape first = scene(flat, 0, 0), second = scene(flat, 1, 0);
  Validator validator(flat.mesh, Topology::kPreserve);
  Hierarchy replayed = test::built(first, 4, Topology::kPreserve);
  Reclusterer r(flat.mesh, replayed, {}), never(flat.mesh, replayed, {.growth = {}, .restart = {.jump = 0}});
  for (int frame = 0; frame < 6; ++frame) {
    const Shape now = scene(flat, frame / 3, frame);
    for (const Swap& swap : stepped(r, now.positions)) apply(replayed, swap);
    stepped(never, now.positions);
    EXPECT_EQ(r.has_restarted(), frame == 3) << frame;
    EXPECT_FALSE(never.has_restarted());
    ASSERT_EQ(replayed, r.hierarchy());
    const auto violation = validator(r.hierarchy());
    ASSERT_FALSE(violation) << "frame " << frame << ": " << violation->line();
  }
  const double scale = normalization(first.positions).scale;
  Reclusterer fresh(flat.mesh, *build_alike(flat.mesh, scene(flat, 1, 3).positions, replayed, {}), {});
  stepped(fresh, scene(flat, 1, 3).positions);
  const std::vector<double> is = level_errors(second, r.hierarchy(), scale),
                            could = level_errors(second, fresh.hierarchy(), scale),
                            was = level_errors(second, never.hierarchy(), scale);
  for (Index level = 1; level < replayed.level_count(); ++level) EXPECT_LT(is[level], 1.1 * could[level]);
  EXPECT_LT(is[1], 0.85 * was[1]);
}

TEST(Reclusterer, FollowsAClipThatIsFastThroughout) {
  const Shape flat = test::jittered(test::sheet(40, 40), 0.1f, 13);
  const Shape first = scene(flat, 0, 0);
  const double scale = normalization(first.positions).scale;
  const Hierarchy base = test::built(first, 4, Topology::kPreserve);
  RestartOptions impatient{.gain = 0.95};
  const RestartOptions patient = impatient;
  impatient.patience = 0;
  Reclusterer r(flat.mesh, base, {.growth = {}, .restart = patient}),
      other(flat.mesh, base, {.growth = {}, .restart = impatient});
  int restarts = 0, other_restarts = 0;
  for (int frame = 0; frame < 8; ++frame) {
    const Shape now = scene(flat, 0, 62 * frame);
    const std::vector<double> were = level_errors(scene(flat, 0, 62 * (frame - 1)), r.hierarchy(), scale),
                              are = level_errors(now, r.hierarchy(), scale);
    double jump = 1;
    for (std::size_t level = 1; level < are.size(); ++level) jump *= are[level] / were[level];
    jump = std::pow(jump, 1 / static_cast<double>(are.size() - 1));
    stepped(r, now.positions);
    stepped(other, now.positions);
    restarts += r.has_restarted();
    other_restarts += other.has_restarted();
    if (frame == 0) continue;
    EXPECT_GT(jump, 1.5) << "slow";
    EXPECT_LT(jump, 2.2) << "a jump";
  }
  EXPECT_LE(restarts, 1) << "one frame is tried";
  EXPECT_GT(other_restarts, 1);
}

TEST(Reclusterer, AsksMoreOfASwapWhereClustersAreSmall) {
  const Shape shape = test::jittered(test::sphere(4), 0.02f, 16);
  const Hierarchy base = test::built(shape, 2, Topology::kPreserve);
  ReclusterOptions options{.threshold = 0.05};
  options.rebirth.hysteresis = 0;
  Reclusterer r(shape.mesh, base, options);
  const double scale = normalization(deformed(shape, 0).positions).scale;
  stepped(r, deformed(shape, 0).positions);
  const Shape now = deformed(shape, 4);
  const Hierarchy last = r.hierarchy();
  const double before = weighted(level_errors(now, last, scale), last, r.growth(), options.coarser_weight);
  const std::vector<double> errors = level_errors(now, last, scale);
  const std::size_t swaps = stepped(r, now.positions).size();
  const double after = weighted(level_errors(now, r.hierarchy(), scale), last, r.growth(), options.coarser_weight);
  ASSERT_GT(swaps, 10u);
  EXPECT_GT(before - after, 0.05 * 16 * errors[1] / last.level_size(1) * static_cast<double>(swaps));
}

// A sheet with creases that wander.
Shape creased(const Shape& sheet, int frame) {
  const float t = 0.2f * static_cast<float>(frame);
  return moved(sheet, [t](Vec3f p) {
    const float z = 1.5f * std::abs(std::sin(0.35f * p.x + 0.2f * p.y + 1.5f * t));
    return Vec3f{p.x, p.y, z + std::abs(std::sin(0.3f * p.y - 0.1f * p.x + t))};
  });
}

TEST(Reclusterer, TurnsTrianglesBackWhereToldTo) {
  const Shape sheet = test::sheet(60, 60);
  const auto count_turned_over = [&](double unfold) {
    ReclusterOptions options{.unfold = unfold};
    options.fit.rounds = 0;
    Reclusterer r(sheet.mesh, test::built(creased(sheet, 0), 4, Topology::kPreserve), options);
    int count = 0;
    for (int frame = 0; frame < 10; ++frame) {
      const Shape now = creased(sheet, frame);
      r.step(now.positions);
      const std::vector<Index> cluster = test::ancestors(r.hierarchy(), 1);
      std::vector<Facing> facings(r.hierarchy().node_count());
      for (const auto& [a, b, c] : now.mesh.triangles) {
        const Vec3d p(now.positions[a]), v = cross(Vec3d(now.positions[b]) - p, Vec3d(now.positions[c]) - p);
        for (const Index vertex : {a, b, c}) facings[cluster[vertex]] += {v, length(v)};
      }
      const auto at = [&](Index node) { return Vec3d(r.positions()[node]); };
      for (const auto& [u, v, w] : now.mesh.triangles) {
        const Index a = cluster[u], b = cluster[v], c = cluster[w];
        if (is_degenerate(Triangle{a, b, c})) continue;
        Facing surface = facings[a];
        surface += facings[b];
        surface += facings[c];
        count += is_turned_over(at(a), at(b), at(c), surface);
      }
    }
    return count;
  };
  EXPECT_GT(count_turned_over(0), 4);
  EXPECT_EQ(count_turned_over(0.5), 0);
}

TEST(Reclusterer, LeavesABaseThatDoesNotFitTheFirstFrameWhereToldTo) {
  const Shape flat = test::jittered(test::sheet(40, 40), 0.1f, 14);
  const Hierarchy other = test::built(scene(flat, 1, 0), 4, Topology::kPreserve);
  for (const bool tries_first : {false, true}) {
    Reclusterer r(flat.mesh, other, {.growth = {}, .restart = {.tries_first = tries_first}});
    stepped(r, scene(flat, 0, 0).positions);
    EXPECT_EQ(r.has_restarted(), tries_first);
  }
}

TEST(Reclusterer, StaysWithAClipThatOnlyGrowsOrMovesOn) {
  const Shape ball = test::jittered(test::sphere(4), 0.02f, 15);
  Reclusterer r(ball.mesh, test::built(ball, 4, Topology::kPreserve), {});
  for (int frame = 0; frame < 5; ++frame) {
    const float size = static_cast<float>(1 << frame);
    stepped(r, moved(ball, [&](Vec3f p) { return p * size + Vec3f{3 * size, 0, 0}; }).positions);
    EXPECT_FALSE(r.has_restarted()) << frame;
  }
}

TEST(Reclusterer, ChangesNoMoreTrianglesOfALevelThanItMay) {
  for (const Topology topology : {Topology::kPreserve, Topology::kFree}) {
    for (const Shape& shape : {test::jittered(test::sphere(4), 0.02f, 4), test::waved(test::sheet(30, 25))}) {
      for (const double share : {0.0, 0.02, 0.2}) {
        const ReclusterOptions options{
            .topology = topology, .quadrics = {}, .growth = {}, .threshold = 0, .most_changed = share};
        Reclusterer r(shape.mesh, test::built(shape, 3, topology), options);
        stepped(r, deformed(shape, 0).positions);
        std::size_t most_used = 0;
        for (int frame = 1; frame < 8; ++frame) {
          const Hierarchy last = r.hierarchy();
          stepped(r, deformed(shape, frame).positions);
          EXPECT_FALSE(r.has_restarted());
          for (Index level = 1; level < last.level_count(); ++level) {
            const std::set<Triangle> before = test::triangles_of(shape.mesh, last, level),
                                     after = test::triangles_of(shape.mesh, r.hierarchy(), level);
            const auto fresh = static_cast<std::size_t>(
                std::ranges::count_if(after, [&](const Triangle& t) { return !before.contains(t); }));
            EXPECT_LE(static_cast<double>(fresh), share * static_cast<double>(before.size()));
            if (level == 1) most_used = std::max(most_used, fresh * 100 / before.size());
          }
        }
        // In percent: it does not just stand still.
        EXPECT_GE(most_used, share > 0.1 ? 4u : share > 0 ? 1u : 0u);
      }
    }
  }
}

TEST(Reclusterer, GivesTheSameTwice) {
  const Shape shape = test::jittered(test::torus(12, 30), 0.05f, 8);
  const Hierarchy base = test::built(shape, 4, Topology::kPreserve);
  Reclusterer a(shape.mesh, base, {}), b(shape.mesh, base, {});
  for (int frame = 0; frame < 5; ++frame) {
    const Shape now = deformed(shape, frame);
    ASSERT_EQ(stepped(a, now.positions), stepped(b, now.positions));
    ASSERT_TRUE(std::equal(a.positions().begin(), a.positions().end(), b.positions().begin()));
    ASSERT_TRUE(std::equal(a.errors().begin(), a.errors().end(), b.errors().begin()));
  }
}

TEST(Reclusterer, SwapsTheSameAtAnyScaleThatIsAPowerOfTwo) {
  const Shape shape = test::jittered(test::sphere(3), 0.05f, 9);
  const Hierarchy base = test::built(shape, 4, Topology::kPreserve);
  for (const float scale : {0x1p-20f, 0x1p14f}) {
    Reclusterer plain(shape.mesh, base, {}), scaled(shape.mesh, base, {});
    for (int frame = 0; frame < 5; ++frame) {
      const Shape now = deformed(shape, frame);
      const Shape other = moved(now, [scale](Vec3f p) { return p * scale; });
      ASSERT_EQ(stepped(plain, now.positions), stepped(scaled, other.positions));
      for (Index node = 0; node < base.node_count(); ++node) {
        ASSERT_EQ(plain.positions()[node] * scale, scaled.positions()[node]);
        ASSERT_FLOAT_EQ(plain.errors()[node] * scale * scale, scaled.errors()[node]);
      }
    }
  }
}

TEST(Reclusterer, GivesThePositionsItWasGivenAndTheMinimaOfTheRest) {
  const Shape shape = deformed(test::jittered(test::sphere(3), 0.05f, 10), 1);
  Reclusterer r(shape.mesh, test::built(shape, 4, Topology::kPreserve), {.fit = {.rounds = 0}});
  stepped(r, shape.positions);
  const Hierarchy& h = r.hierarchy();
  for (Index v = 0; v < h.vertex_count(); ++v) {
    EXPECT_EQ(r.positions()[v], shape.positions[v]);
    EXPECT_EQ(r.errors()[v], 0.0f);
  }
  const Normalization n = normalization(shape.positions);
  for (Index level = 1; level < h.level_count(); ++level) {
    double sum = 0;
    for (Index node = h.level_begin[level]; node < h.level_begin[level + 1]; ++node) {
      const double root = static_cast<double>(r.errors()[node]) * n.scale * n.scale;
      sum += root * root;
      EXPECT_LT(length(r.positions()[node]), 2.5f);
    }
    EXPECT_NEAR(sum, r.total_error(level), 1e-5 * sum);
  }
}

TEST(Reclusterer, UsesTheGrowthItIsGivenOrOneThatFits) {
  const Shape shape = test::jittered(test::sphere(5), 0.002f, 11);
  const Hierarchy base = test::built(shape, 4, Topology::kPreserve);
  Reclusterer fitted(shape.mesh, base, {}), given(shape.mesh, base, {.topology = {}, .quadrics = {}, .growth = 1.5});
  stepped(fitted, shape.positions), stepped(given, shape.positions);
  EXPECT_EQ(given.growth(), 1.5);
  // The squared distance of a smooth surface grows as the fourth power of the size of its triangles.
  EXPECT_GT(fitted.growth(), 1.4);
  EXPECT_LT(fitted.growth(), 2.4);
}

TEST(Reclusterer, HasNothingToDoOnASingleLevel) {
  const Shape shape = test::tetrahedron();
  Reclusterer r(shape.mesh, test::built(shape, 8, Topology::kPreserve), {});
  EXPECT_TRUE(stepped(r, shape.positions).empty());
  EXPECT_EQ(r.positions().size(), 4u);
}

TEST(Reclusterer, TakesFramesWithoutAreaAndWithoutExtent) {
  const Shape shape = test::jittered(test::sphere(3), 0.05f, 12);
  const Hierarchy base = test::built(shape, 4, Topology::kPreserve);
  const std::vector<std::vector<Vec3f>> frames = {
      shape.positions,
      moved(shape,
            [](Vec3f p) {
              return Vec3f{p.x, p.y, 0};
            })
          .positions,
      moved(shape,
            [](Vec3f p) {
              return Vec3f{0.3f, 0.2f, -0.9f} * p.x;
            })
          .positions,
      moved(shape,
            [](Vec3f) {
              return Vec3f{3, 4, 5};
            })
          .positions,
      shape.positions,
      moved(shape, [](Vec3f p) { return p * 1e4f; }).positions,
      moved(shape,
            [](Vec3f p) {
              return p * 1e-4f + Vec3f{1e3f, 0, 0};
            })
          .positions,
  };
  for (std::size_t first = 0; first < frames.size(); ++first) {
    Reclusterer r(shape.mesh, base, {});
    Validator validator(shape.mesh, Topology::kPreserve);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const std::vector<Vec3f>& positions = frames[(first + f) % frames.size()];
      stepped(r, positions);
      Box box;
      for (const Vec3f& p : positions) box.add(static_cast<Vec3d>(p));
      ASSERT_FALSE(validator(r.hierarchy()));
      for (const Vec3f& p : r.positions()) {
        ASSERT_TRUE(is_finite(p));
        ASSERT_LT(length(static_cast<Vec3d>(p) - box.center()), box.diagonal() * 1.5 + 1e-3) << first << " " << f;
      }
    }
  }
}

TEST(Reclusterer, LeavesIsolatedVerticesWhereTheyAre) {
  Shape shape = test::jittered(test::sphere(3), 0.05f, 13);
  shape.positions.push_back({3, 3, 3});
  ++shape.mesh.vertex_count;
  const Hierarchy base = test::built(shape, 4, Topology::kFree);
  Reclusterer r(shape.mesh, base, {.topology = Topology::kFree, .quadrics = {}, .growth = {}});
  for (int frame = 0; frame < 3; ++frame) {
    Shape now = deformed(shape, frame);
    for (const Swap& swap : stepped(r, now.positions)) EXPECT_NE(swap.node, shape.mesh.vertex_count - 1);
    const Index parent = base.parent[shape.mesh.vertex_count - 1];
    EXPECT_NEAR(length(r.positions()[parent] - now.positions.back()), 0, 1e-5);
  }
}

}  // namespace
}  // namespace limber
