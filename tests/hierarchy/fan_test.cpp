// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/fan.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "eval/closest_point.h"

namespace limber {
namespace {

struct Corners {
  Vec3f a, b;
};

Fan fan_of(const std::vector<Corners>& triangles) {
  Fan fan;
  for (Index i = 0; i < triangles.size(); ++i) fan.add(2 * i, triangles[i].a, 2 * i + 1, triangles[i].b);
  fan.finish();
  return fan;
}

// Where a place is, by the triangle that its corners name.
Vec3d position(const std::vector<Corners>& triangles, const Fan::Place& place) {
  const Corners& corners = triangles[place.a / 2];
  EXPECT_EQ(place.a + 1, place.b);
  EXPECT_GE(place.at_a, 0);
  EXPECT_GE(place.at_b, 0);
  EXPECT_LE(place.at_a + place.at_b, 1 + 1e-5);
  return Vec3d(corners.a) * double{place.at_a} + Vec3d(corners.b) * double{place.at_b};
}

double squared_length_of_way(const Fan::Place& place) {
  return squared_length(Vec3d(place.direction)) * double{place.steps} * double{place.steps};
}

Vec3f random_point(std::mt19937& random) {
  std::uniform_real_distribution<float> number(-1, 1);
  return {number(random), number(random), number(random)};
}

// Whether the closest point of the triangle's plane lies in it; how far that is.
bool is_below(const Vec3f& point, const Corners& corners, double& squared) {
  const eval::ClosestPoint closest =
      eval::closest_point_on_triangle(Vec3d(point), {}, Vec3d(corners.a), Vec3d(corners.b));
  squared = closest.squared_distance;
  return *std::min_element(closest.barycentric.begin(), closest.barycentric.end()) > 1e-6;
}

TEST(Fan, FindsTheClosestPointOrANearOneBelow) {
  std::mt19937 random(1);
  int below_count = 0, side_count = 0;
  for (int round = 0; round < 20000; ++round) {
    std::vector<Corners> triangles(1 + random() % 9);
    for (Corners& corners : triangles) corners = {random_point(random), random_point(random)};
    const Vec3f point = random_point(random);
    bool has_below = false;
    double closest_below = 1e30, closest = 1e30;
    for (const Corners& corners : triangles) {
      double squared = 0;
      if (is_below(point, corners, squared)) has_below = true, closest_below = std::min(closest_below, squared);
      closest = std::min(closest, squared);
    }
    const Fan::Place place = fan_of(triangles).closest(point);
    const Vec3d way = Vec3d(point) - position(triangles, place);
    const bool is_near = has_below && closest_below < 0.05 * squared_length(Vec3d(point));
    const double expected = is_near ? closest_below : closest;
    ++(is_near ? below_count : side_count);
    EXPECT_NEAR(squared_length(way), expected, 2e-4);
    EXPECT_NEAR(squared_length_of_way(place), expected, 2e-4);
    EXPECT_NEAR(double{place.by_squared} * squared_length(Vec3d(place.direction)), 1, 1e-4);
    EXPECT_LT(length(way - Vec3d(place.direction) * double{place.steps}), 2e-2);
  }
  EXPECT_GT(below_count, 1000);
  EXPECT_GT(side_count, 3000);
}

TEST(Fan, FindsTheNodeWhereItIsClosest) {
  const std::vector<Corners> roof{{{1, 0, -1}, {0, 1, -1}}, {{0, 1, -1}, {-1, 0, -1}}};
  const Fan::Place place = fan_of(roof).closest({0, -0.1f, 2});
  EXPECT_EQ(place.at_a, 0);
  EXPECT_EQ(place.at_b, 0);
  EXPECT_EQ(place.direction, (Vec3f{0, -0.1f, 2}));
}

TEST(Fan, BearsTrianglesWithoutArea) {
  const Vec3f out{1, 2, 3};
  for (const Corners& corners : {Corners{{}, {}}, Corners{out, out}, Corners{out, {}}, Corners{out, {2, 4, 6}}}) {
    const Fan::Place place = fan_of({corners}).closest({1, 0, 0});
    EXPECT_TRUE(is_finite(place.direction));
    EXPECT_LE(squared_length_of_way(place), 1.00001);
  }
}

TEST(Fan, HasADirectionWhereThePointIsOnATriangle) {
  const Fan::Place place = fan_of({{{1, 0, 0}, {0, 1, 0}}}).closest({0.25f, 0.25f, 0});
  EXPECT_EQ(place.steps, 0);
  EXPECT_NEAR(place.direction.z * place.direction.z * place.by_squared, 1, 1e-6);
}

TEST(Fan, ForgetsTheNodeBefore) {
  Fan fan = fan_of(std::vector<Corners>(6, {{0, 0, 1}, {0, 1, 1}}));
  fan.clear();
  EXPECT_TRUE(fan.empty());
  fan.add(8, {1, 0, 0}, 9, {0, 1, 0});
  fan.finish();
  const Fan::Place place = fan.closest({0, 0.25f, 1});
  EXPECT_EQ(place.a, 8u);
  EXPECT_NEAR(squared_length_of_way(place), 1, 1e-6);
}

}  // namespace
}  // namespace limber
