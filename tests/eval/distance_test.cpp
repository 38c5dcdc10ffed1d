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

TEST(Distance, OfAnInscribedOctahedronToItsSphereIsTheIntegral) {
  // The faces lie h from the centre and have the inradius r. A point is 1 - |x| from the sphere, with the mean of |x|
  // from an integral over the angle, and the mean of |x|^2 = 1/2.
  const double h = 1 / std::sqrt(3), r = 1 / std::sqrt(6), area = std::sqrt(3) / 2;
  const auto outer = [&](double angle) {
    const double squared = h * h + std::pow(r / std::cos(angle), 2);
    return (squared * std::sqrt(squared) - h * h * h) / 3;
  };
  const int steps = 200;
  double mean_length = 0;
  for (int i = 0; i < steps; ++i) mean_length += outer((i + 0.5) * std::numbers::pi / 3 / steps);
  mean_length *= 6 * std::numbers::pi / 3 / steps / area;

  const Distance distance = measure_distance(test::sphere(150), test::octahedron(), kFew);
  const double percent = 100 / (2 * std::sqrt(3));
  EXPECT_NEAR(distance.to_original.mean, percent * (1 - mean_length), 1e-3 * distance.to_original.mean);
  EXPECT_NEAR(distance.to_original.rms, percent * std::sqrt(1.5 - 2 * mean_length), 1e-3 * distance.to_original.rms);
  EXPECT_NEAR(distance.to_original.max, percent * (1 - h), 2e-4 * distance.to_original.max);
}

TEST(Distance, OfAShiftedSphereIsTheCosineOfTheShift) {
  const double shift = 1.0 / 64;
  const Shape sphere = test::sphere(150);
  const Distance distance = measure_distance(sphere, test::shifted(sphere, {0, 0, static_cast<float>(shift)}), kFew);
  const double percent = 100 / (2 * std::sqrt(3));
  for (const OneWayDistance& way : {distance.to_approximation, distance.to_original}) {
    EXPECT_NEAR(way.rms, percent * shift / std::sqrt(3), 1e-2 * way.rms);
    EXPECT_NEAR(way.mean, percent * shift / 2, 1e-2 * way.mean);
    EXPECT_NEAR(way.max, percent * shift, 1e-3 * way.max);
  }
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
