// SPDX-License-Identifier: Apache-2.0
#include "eval/distance.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <tbb/global_control.h>
#include <vector>

#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

const DistanceOptions kFew{.samples = {.per_triangle = 1, .at_least = 20'000}};

void expect_relative(const Distance& one, const Distance& other, double tolerance) {
  EXPECT_NEAR(one.rms, other.rms, tolerance * other.rms);
  EXPECT_NEAR(one.mean, other.mean, tolerance * other.mean);
  EXPECT_NEAR(one.max, other.max, tolerance * other.max);
}

TEST(Distance, OfAMeshToItselfIsNothing) {
  const Shape sphere = test::sphere(24);
  const Distance distance = measure_distance(sphere, sphere, kFew);
  EXPECT_LT(distance.max, 1e-13);
  EXPECT_NEAR(distance.diagonal, 2 * std::sqrt(3), 1e-6);
}

TEST(Distance, OfParallelPlanesIsTheirDistanceExactly) {
  const Distance distance = measure_distance(test::square(8), test::square(1, 0.25f), kFew);
  const double expected = 25 / std::sqrt(2);
  for (const double value : {distance.rms, distance.mean, distance.max, distance.to_original.rms,
                             distance.to_approximation.mean, distance.to_approximation.max}) {
    EXPECT_NEAR(value, expected, 1e-12 * expected);
  }
  EXPECT_LT(distance.rms_error, 1e-12);
}

TEST(Distance, IsTheLargerOfTheTwoDirections) {
  // Half of the square: every point of the half lies on the square, but not the other way round.
  const Shape whole = test::square(8);
  const Shape half = test::moved(whole, [](Vec3f p) { return Vec3f{p.x / 2, p.y, p.z}; });
  const Distance distance = measure_distance(whole, half, kFew);
  EXPECT_LT(distance.to_original.max, 1e-12);
  const double percent = 100 / std::sqrt(2);
  EXPECT_EQ(distance.rms, distance.to_approximation.rms);
  EXPECT_NEAR(distance.rms, percent * std::sqrt(1.0 / 24), 2e-3 * distance.rms);
  EXPECT_NEAR(distance.mean, percent / 8, 2e-3 * distance.mean);
  EXPECT_NEAR(distance.max, percent / 2, 1e-12);

  const Distance back = measure_distance(half, whole, kFew);
  EXPECT_EQ(back.rms, back.to_original.rms);
  EXPECT_NEAR(back.rms, 100 / std::sqrt(1.25) * std::sqrt(1.0 / 24), 2e-3 * back.rms) << "percent of the original";
}

// A regular polyhedron with its vertices on the unit sphere.
struct Regular {
  const char* name;
  Shape shape;
  int corners;    // of a face
  double height;  // of the faces above the centre
};

std::vector<Regular> regular_polyhedra() {
  const float third = static_cast<float>(1 / std::sqrt(3));
  const Shape tetrahedron{
      {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}},
      {{third, third, third}, {-third, -third, third}, {-third, third, -third}, {third, -third, -third}}};
  Shape cube{{{0, 2, 3},
              {0, 3, 1},
              {4, 5, 7},
              {4, 7, 6},
              {0, 1, 5},
              {0, 5, 4},
              {2, 6, 7},
              {2, 7, 3},
              {0, 4, 6},
              {0, 6, 2},
              {1, 3, 7},
              {1, 7, 5}},
             {}};
  for (int i = 0; i < 8; ++i)
    cube.positions.push_back({i & 1 ? third : -third, i & 2 ? third : -third, i & 4 ? third : -third});
  const double golden = std::numbers::phi, radius = std::sqrt(1 + golden * golden);
  const float a = static_cast<float>(1 / radius), b = static_cast<float>(golden / radius);
  const Shape icosahedron{{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}},
                          {{-a, b, 0},
                           {a, b, 0},
                           {-a, -b, 0},
                           {a, -b, 0},
                           {0, -a, b},
                           {0, a, b},
                           {0, -a, -b},
                           {0, a, -b},
                           {b, 0, -a},
                           {b, 0, a},
                           {-b, 0, -a},
                           {-b, 0, a}}};
  const double icosahedron_height = golden * golden / (std::sqrt(3) * radius);
  return {{"tetrahedron", tetrahedron, 3, 1.0 / 3},
          {"cube", cube, 4, 1 / std::sqrt(3)},
          {"octahedron", test::octahedron(), 3, 1 / std::sqrt(3)},
          {"icosahedron", icosahedron, 3, icosahedron_height}};
}

struct Moments {
  double mean, squared;  // of 1 - |x| over the faces
};

// A point at the distance s from a face's centre is 1 - sqrt(h^2 + s^2) from the sphere. The integrals over s are
// closed; the one over the angle, from the middle of a side to a corner, is by the midpoint rule.
Moments distance_to_sphere(const Regular& polyhedron) {
  const double h = polyhedron.height, sector = std::numbers::pi / polyhedron.corners;
  const double inradius = std::sqrt(1 - h * h) * std::cos(sector);
  const int steps = 400;
  double area = 0, length = 0, squared = 0;
  for (int i = 0; i < steps; ++i) {
    const double s = inradius / std::cos((i + 0.5) * sector / steps), outer = h * h + s * s;
    area += s * s / 2;
    length += (outer * std::sqrt(outer) - h * h * h) / 3;
    squared += h * h * s * s / 2 + s * s * s * s / 4;
  }
  return {1 - length / area, 1 - 2 * length / area + squared / area};
}

constexpr double kSpherePercent = 100 / (2 * std::numbers::sqrt3);

TEST(Distance, OfAnInscribedPolyhedronToItsSphereIsTheIntegral) {
  const Shape sphere = test::sphere(100);
  for (const Regular& polyhedron : regular_polyhedra()) {
    SCOPED_TRACE(polyhedron.name);
    const Moments expected = distance_to_sphere(polyhedron);
    const Distance distance = measure_distance(sphere, polyhedron.shape, kFew);
    const OneWayDistance& way = distance.to_original;
    EXPECT_NEAR(way.mean, kSpherePercent * expected.mean, 2e-3 * way.mean);
    EXPECT_NEAR(way.rms, kSpherePercent * std::sqrt(expected.squared), 2e-3 * way.rms);
    EXPECT_NEAR(way.max, kSpherePercent * (1 - polyhedron.height), 1e-3 * way.max);
    EXPECT_NEAR(distance.to_approximation.max, way.max, 1e-3 * way.max) << "over the middle of a face";
  }
}

TEST(Distance, OfAShiftedSphereIsTheCosineOfTheShift) {
  // sqrt(1 - 2 d c + d^2) - 1 over c in [-1, 1]: its square has the mean d^2 / 3, its size the mean d / 2.
  const Shape sphere = test::sphere(80);
  for (const float shift : {1.0f / 8, 1.0f / 4}) {
    const Distance distance = measure_distance(sphere, test::shifted(sphere, {0, 0, shift}), kFew);
    for (const OneWayDistance& way : {distance.to_approximation, distance.to_original}) {
      EXPECT_NEAR(way.rms, kSpherePercent * shift / std::sqrt(3), 3e-3 * way.rms) << shift;
      EXPECT_NEAR(way.mean, kSpherePercent * shift / 2, 3e-3 * way.mean) << shift;
      EXPECT_NEAR(way.max, kSpherePercent * shift, 1e-3 * way.max) << shift;
    }
  }
}

TEST(Distance, OfParallelPlanesIsTheirDistanceWhicheverWayItIsSampled) {
  DistanceOptions metro = kFew;
  metro.sampling = Sampling::kMetro;
  const Distance distance = measure_distance(test::square(8), test::square(3, 0.25f), metro);
  EXPECT_NEAR(distance.rms, 25 / std::sqrt(2), 1e-9);
  EXPECT_NEAR(distance.mean, 25 / std::sqrt(2), 1e-9);
  EXPECT_GT(distance.to_original.sample_count, 19'000u);
}

TEST(Distance, IsTheSameAtEveryScale) {
  const Shape fine = test::sphere(40), coarse = test::sphere(8);
  const Distance expected = measure_distance(fine, coarse, kFew);
  for (const float scale : {1e-3f, 1e-2f, 7.0f, 1e2f, 1e4f}) {
    const Distance distance = measure_distance(test::scaled(fine, scale), test::scaled(coarse, scale), kFew);
    expect_relative(distance, expected, 1e-5);
  }
  // A power of two changes no digit.
  const Distance distance = measure_distance(test::scaled(fine, 0x1p-12f), test::scaled(coarse, 0x1p-12f), kFew);
  EXPECT_EQ(distance.rms, expected.rms);
  EXPECT_EQ(distance.max, expected.max);
}

TEST(Distance, LosesOnlyWhatThePositionsLoseFarFromTheOrigin) {
  // Positions on a grid that single precision still holds 10,000 diagonals away.
  const auto on_grid = [](Vec3f p) {
    const auto round = [](float x) { return std::round(x * 512) / 512; };
    return Vec3f{round(p.x), round(p.y), round(p.z)};
  };
  const Shape fine = test::moved(test::sphere(30), on_grid), coarse = test::moved(test::sphere(8), on_grid);
  const Vec3f far{30'000, -16'000, 20'000};
  const Distance expected = measure_distance(fine, coarse, kFew);
  const Distance distance = measure_distance(test::shifted(fine, far), test::shifted(coarse, far), kFew);
  expect_relative(distance, expected, 1e-9);
}

TEST(Distance, GivesTheSameForEveryNumberOfThreads) {
  const Shape fine = test::sphere(40), coarse = test::sphere(8);
  const Distance all = measure_distance(fine, coarse, kFew);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  const Distance one = measure_distance(fine, coarse, kFew);
  EXPECT_EQ(one.rms, all.rms);
  EXPECT_EQ(one.mean, all.mean);
  EXPECT_EQ(one.max, all.max);
  EXPECT_EQ(one.rms_error, all.rms_error);
}

TEST(Distance, KnowsItsOwnError) {
  // The spread of the results over seeds, beside the error that each of them states.
  const Shape fine = test::sphere(20), coarse = test::sphere(5);
  double sum = 0, squares = 0, stated = 0;
  const int seeds = 40;
  for (int seed = 0; seed < seeds; ++seed) {
    const DistanceOptions options{.samples = {.at_least = 2000, .seed = static_cast<std::uint64_t>(seed)}};
    const OneWayDistance way = measure_distance(fine, coarse, options).to_original;
    EXPECT_EQ(way.sample_count, 2000u);
    sum += way.rms, squares += way.rms * way.rms, stated += way.rms_error / seeds;
  }
  const double spread = std::sqrt((squares - sum * sum / seeds) / (seeds - 1));
  EXPECT_LT(spread, 1.5 * stated);
  EXPECT_LT(stated, 0.02 * sum / seeds);
}

TEST(Distance, TheTruthLiesWithinItsConfidence) {
  const Regular cube = regular_polyhedra()[1];
  const double truth = kSpherePercent * std::sqrt(distance_to_sphere(cube).squared);
  const Shape sphere = test::sphere(80);
  const ClosestPointTree sphere_tree(sphere), cube_tree(cube.shape);
  const int seeds = 40;
  int covered = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const DistanceOptions options{
        .samples = {.per_triangle = 0, .at_least = 500, .seed = static_cast<std::uint64_t>(seed)}};
    const OneWayDistance way = measure_distance(sphere, sphere_tree, cube.shape, cube_tree, options).to_original;
    if (std::abs(way.rms - truth) <= 1.96 * way.rms_error) ++covered;
  }
  EXPECT_GE(covered, 0.9 * seeds);
}

TEST(Distance, FindsTheMaximumWhateverTheSeed) {
  // A cone whose axis meets the approximation in the middle of a triangle, where few samples come near.
  const Shape coarse = test::square(2);
  const Shape fine = test::moved(test::square(64), [](Vec3f p) {
    const float x = p.x - 0.375f, y = p.y - 0.1875f;
    return Vec3f{p.x, p.y, std::max(0.0f, 0.125f - std::sqrt(x * x + y * y))};
  });
  std::vector<double> largest;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    largest.push_back(measure_distance(fine, coarse, {.samples = {.at_least = 2000, .seed = seed}}).to_original.max);
  }
  std::sort(largest.begin(), largest.end());
  EXPECT_GT(largest.front(), 0.995 * largest.back());
}

TEST(Distance, CountsVerticesTowardsTheMaximum) {
  // A spike so thin that no sample falls near its tip.
  const Shape flat = test::square(2);
  Shape spiked = flat;
  spiked.positions.insert(spiked.positions.end(), {{0.5f, 0.5f, 0}, {0.5f, 0.5f, 1e-7f}, {0.5f, 0.5f, 1}});
  spiked.triangles.push_back({9, 10, 11});
  const Distance distance = measure_distance(spiked, flat, kFew);
  EXPECT_NEAR(distance.max, 100 / std::sqrt(3), 1e-4);
}

TEST(Distance, DoesNotSeeIsolatedVertices) {
  const Shape square = test::square(4);
  Shape with_stray = test::square(4, 0.5f);
  with_stray.positions.push_back({1000, 1000, 1000});
  EXPECT_NEAR(measure_distance(with_stray, square, kFew).max, 50 / std::sqrt(2), 1e-9);
  EXPECT_NEAR(measure_distance(square, with_stray, kFew).max, 50 / std::sqrt(2), 1e-9);
}

}  // namespace
}  // namespace limber::eval
