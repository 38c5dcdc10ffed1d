// SPDX-License-Identifier: Apache-2.0
#include "eval/sample_surface.h"

#include <gtest/gtest.h>

#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

// A small and a large triangle beside each other (areas 1 : 3), and one without area.
Shape uneven() { return {{{0, 1, 2}, {1, 3, 2}, {0, 1, 1}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {4, 0, 0}}}; }

std::vector<SurfaceSample> all(const AreaSamples& samples) {
  std::vector<SurfaceSample> list(samples.size());
  samples.fill(0, list);
  return list;
}

bool same(const SurfaceSample& a, const SurfaceSample& b) {
  return a.triangle == b.triangle && a.barycentric == b.barycentric;
}

TEST(SampleOptions, TakesTheLargerOfBothCounts) {
  const SampleOptions options;
  EXPECT_EQ(options.total(12), 100'000u);
  EXPECT_EQ(options.total(16'843), 168'430u);
  EXPECT_EQ((SampleOptions{.per_triangle = 0, .at_least = 0}.total(5)), 1u);
}

TEST(AreaSamples, GivesEachTriangleItsShareToASample) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const AreaSamples samples(uneven(), 1001, seed);
    EXPECT_EQ(samples.size(), 1001u);
    std::array<int, 3> counts{};
    for (const SurfaceSample& sample : all(samples)) ++counts[sample.triangle];
    EXPECT_NEAR(counts[0], 250.25, 1);
    EXPECT_NEAR(counts[1], 750.75, 1);
    EXPECT_EQ(counts[2], 0);
  }
}

TEST(AreaSamples, HasBarycentricCoordinatesAndTheirMeanIsAThird) {
  std::array<double, 3> sum{};
  double second_moment = 0;
  const std::vector<SurfaceSample> samples = all(AreaSamples(test::octahedron(), 20'000, 9));
  for (const SurfaceSample& sample : samples) {
    double total = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(sample.barycentric[k], 0);
      total += sample.barycentric[k];
      sum[k] += sample.barycentric[k] / 20'000;
    }
    EXPECT_NEAR(total, 1, 1e-15);
    second_moment += sample.barycentric[1] * sample.barycentric[1] / 20'000;
  }
  for (const double mean : sum) EXPECT_NEAR(mean, 1.0 / 3, 1e-3);
  EXPECT_NEAR(second_moment, 1.0 / 6, 1e-3);
}

TEST(AreaSamples, GivesTheSamePiecesAsTheWhole) {
  const AreaSamples samples(test::sphere(9), 5000, 4);
  const std::vector<SurfaceSample> whole = all(samples);
  for (std::size_t first = 0; first < whole.size(); first += 777) {
    std::vector<SurfaceSample> piece(std::min<std::size_t>(777, whole.size() - first));
    samples.fill(first, piece);
    for (std::size_t i = 0; i < piece.size(); ++i) EXPECT_TRUE(same(piece[i], whole[first + i])) << first + i;
  }
  samples.fill(whole.size(), {});
}

TEST(AreaSamples, DependsOnTheSeedOnly) {
  const std::vector<SurfaceSample> one = all(AreaSamples(test::octahedron(), 100, 1));
  const std::vector<SurfaceSample> again = all(AreaSamples(test::octahedron(), 100, 1));
  const std::vector<SurfaceSample> other = all(AreaSamples(test::octahedron(), 100, 2));
  EXPECT_TRUE(std::equal(one.begin(), one.end(), again.begin(), same));
  EXPECT_FALSE(std::equal(one.begin(), one.end(), other.begin(), same));
}

TEST(AreaSamples, SpreadsEvenlyOverASurfaceWithoutArea) {
  const Shape flat{{{0, 0, 1}, {1, 1, 0}}, {{0, 0, 0}, {1, 0, 0}}};
  std::array<int, 2> counts{};
  for (const SurfaceSample& sample : all(AreaSamples(flat, 10, 1))) ++counts[sample.triangle];
  EXPECT_EQ(counts, (std::array<int, 2>{5, 5}));
}

TEST(AreaSamples, FallsEquallyOftenOnTrianglesOfOneSizeOverManySeeds) {
  // Fewer samples than triangles: 4 on 32.
  const Shape square = test::square(4);
  std::vector<int> counts(32, 0);
  for (std::uint64_t seed = 0; seed < 3200; ++seed) {
    for (const SurfaceSample& sample : all(AreaSamples(square, 4, seed))) ++counts[sample.triangle];
  }
  for (const int count : counts) EXPECT_NEAR(count, 400, 80);
}

TEST(MetroSamples, HoldEveryUsedVertexOnceAndEveryLongEdge) {
  Shape shape = test::octahedron();
  shape.positions.push_back({9, 9, 9});  // isolated: not on the surface
  const Surface surface = shape;
  const std::vector<SurfaceSample> samples = sample_like_metro(surface, 2000, 1);
  std::size_t vertices = 0, on_edges = 0;
  for (const SurfaceSample& sample : samples) {
    int zeros = 0;
    for (const double weight : sample.barycentric) zeros += weight == 0;
    vertices += zeros == 2;
    on_edges += zeros == 1;
  }
  EXPECT_EQ(vertices, 6u);
  const double per_length = std::sqrt((2000 - 6) / (8 * std::sqrt(3) / 2));
  EXPECT_NEAR(static_cast<double>(on_edges), 12 * std::sqrt(2) * per_length, 2);
  EXPECT_NEAR(static_cast<double>(samples.size()), 2000, 60);
}

TEST(MetroSamples, AreTheVerticesWhereTheTotalIsSmaller) {
  EXPECT_EQ(sample_like_metro(test::octahedron(), 3, 1).size(), 6u);
}

}  // namespace
}  // namespace limber::eval
