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

struct Place {
  Index a, b;
  float at_a, at_b;
  Vec3f direction;
  float by_squared, steps;
};

Place place_of(const Fan::Places& places, unsigned lane) {
  const auto& [x, y, z] = places.direction;
  return {places.a[lane],          places.b[lane],    places.at_a[lane], places.at_b[lane], {x[lane], y[lane], z[lane]},
          places.by_squared[lane], places.steps[lane]};
}

// Asked for in one of four lanes, beside others.
Place ask(const Fan& fan, const Vec3f& point, unsigned lane = 0) {
  Vector4 points{{0.5f, -0.5f, 0.25f, 3}, {0, 1, -1, 2}, {-0.25f, 0, 1, 0.5f}};
  points.x[lane] = point.x, points.y[lane] = point.y, points.z[lane] = point.z;
  return place_of(fan.closest(points), lane);
}

// Where a place is, by the triangle that its corners name.
Vec3d position(const std::vector<Corners>& triangles, const Place& place) {
  const Corners& corners = triangles[place.a / 2];
  EXPECT_EQ(place.a + 1, place.b);
  EXPECT_GE(place.at_a, 0);
  EXPECT_GE(place.at_b, 0);
  EXPECT_LE(place.at_a + place.at_b, 1 + 1e-5);
  return Vec3d(corners.a) * double{place.at_a} + Vec3d(corners.b) * double{place.at_b};
}

double squared_length_of_way(const Place& place) {
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
    const Place place = ask(fan_of(triangles), point, static_cast<unsigned>(round % 4));
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

TEST(Fan, FindsTheSameForAPointWhateverStandsBesideIt) {
  std::mt19937 random(2);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Corners> triangles(1 + random() % 9);
    for (Corners& corners : triangles) corners = {random_point(random), random_point(random)};
    const Fan fan = fan_of(triangles);
    Vec3f points[4];
    Vector4 all{};
    for (unsigned lane = 0; lane < 4; ++lane) {
      const Vec3f& p = points[lane] = random_point(random);
      all.x[lane] = p.x, all.y[lane] = p.y, all.z[lane] = p.z;
    }
    const Fan::Places places = fan.closest(all);
    for (unsigned lane = 0; lane < 4; ++lane) {
      const Place place = place_of(places, lane), alone = ask(fan, points[lane], (lane + 1) % 4);
      EXPECT_EQ(place.a, alone.a);
      EXPECT_EQ(place.at_a, alone.at_a);
      EXPECT_EQ(place.at_b, alone.at_b);
      EXPECT_EQ(place.direction, alone.direction);
      EXPECT_EQ(place.steps, alone.steps);
    }
  }
}

TEST(Fan, FindsTheNodeWhereItIsClosest) {
  const std::vector<Corners> roof{{{1, 0, -1}, {0, 1, -1}}, {{0, 1, -1}, {-1, 0, -1}}};
  const Place place = ask(fan_of(roof), {0, -0.1f, 2});
  EXPECT_EQ(place.at_a, 0);
  EXPECT_EQ(place.at_b, 0);
  EXPECT_EQ(place.direction, (Vec3f{0, -0.1f, 2}));
}

TEST(Fan, BearsTrianglesWithoutArea) {
  const Vec3f out{1, 2, 3};
  for (const Corners& corners : {Corners{{}, {}}, Corners{out, out}, Corners{out, {}}, Corners{out, {2, 4, 6}}}) {
    const Place place = ask(fan_of({corners}), {1, 0, 0});
    EXPECT_TRUE(is_finite(place.direction));
    EXPECT_LE(squared_length_of_way(place), 1.00001);
  }
}

TEST(Fan, HasADirectionWhereThePointIsOnATriangle) {
  const Place place = ask(fan_of({{{1, 0, 0}, {0, 1, 0}}}), {0.25f, 0.25f, 0});
  EXPECT_EQ(place.steps, 0);
  EXPECT_NEAR(place.direction.z * place.direction.z * place.by_squared, 1, 1e-6);
}

TEST(Fan, ForgetsTheNodeBefore) {
  Fan fan = fan_of(std::vector<Corners>(6, {{0, 0, 1}, {0, 1, 1}}));
  fan.clear();
  EXPECT_TRUE(fan.empty());
  fan.add(8, {1, 0, 0}, 9, {0, 1, 0});
  fan.finish();
  const Place place = ask(fan, {0, 0.25f, 1});
  EXPECT_EQ(place.a, 8u);
  EXPECT_NEAR(squared_length_of_way(place), 1, 1e-6);
}

}  // namespace
}  // namespace limber
