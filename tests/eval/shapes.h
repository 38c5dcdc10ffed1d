// SPDX-License-Identifier: Apache-2.0
// Small surfaces whose measures are known.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "eval/surface.h"

namespace limber::eval::test {

// Owns what a Surface refers to.
struct Shape {
  std::vector<Triangle> triangles;
  std::vector<Vec3f> positions;

  operator Surface() const { return {triangles, positions}; }
};

template <class Move>
Shape moved(Shape shape, const Move& move) {
  for (Vec3f& p : shape.positions) p = move(p);
  return shape;
}

inline Shape scaled(const Shape& shape, float factor) {
  return moved(shape, [&](Vec3f p) { return p * factor; });
}

inline Shape shifted(const Shape& shape, Vec3f by) {
  return moved(shape, [&](Vec3f p) { return p + by; });
}

// The unit square at height z, normal up, in steps * steps squares of two triangles. Exact for steps a power of two.
inline Shape square(Index steps, float z = 0) {
  Shape shape;
  const Index row = steps + 1;
  for (Index i = 0; i < row; ++i) {
    for (Index j = 0; j < row; ++j) {
      shape.positions.push_back(
          {static_cast<float>(j) / static_cast<float>(steps), static_cast<float>(i) / static_cast<float>(steps), z});
    }
  }
  for (Index i = 0; i < steps; ++i) {
    for (Index j = 0; j < steps; ++j) {
      const Index v = i * row + j;
      shape.triangles.push_back({v, v + 1, v + row + 1});
      shape.triangles.push_back({v, v + row + 1, v + row});
    }
  }
  return shape;
}

// The unit sphere, facing outwards, its vertices on 2 * steps meridians and steps - 1 parallels, and the poles.
inline Shape sphere(Index steps) {
  Shape shape;
  const Index around = 2 * steps;
  for (Index i = 0; i <= steps; ++i) {
    const double polar = std::numbers::pi * i / steps;
    for (Index j = 0; j < around; ++j) {
      const double turn = std::numbers::pi * j / steps;
      const Vec3d p{std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
      shape.positions.push_back(Vec3f(p));
    }
  }
  for (Index i = 0; i < steps; ++i) {
    for (Index j = 0; j < around; ++j) {
      const Index next = (j + 1) % around;
      const Index a = i * around + j, b = i * around + next, c = a + around, d = b + around;
      if (i > 0) shape.triangles.push_back({a, d, b});
      if (i + 1 < steps) shape.triangles.push_back({a, c, d});
    }
  }
  return shape;
}

inline Shape octahedron() {
  return {{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}},
          {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
}

// Triangles anywhere in the unit cube, a third of them degenerate in one way or another.
inline Shape soup(std::size_t triangle_count, unsigned seed) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(random() % 4096) / 4096; };
  Shape shape;
  for (Index t = 0; t < triangle_count; ++t) {
    const Vec3f a{unit(), unit(), unit()};
    Vec3f b = a + Vec3f{unit(), unit(), unit()} * 0.25f;
    Vec3f c = a + Vec3f{unit(), unit(), unit()} * 0.25f;
    if (t % 9 == 0) b = c = a;
    if (t % 9 == 1) c = b;
    if (t % 9 == 2) c = a + (b - a) * 0.5f;
    shape.positions.insert(shape.positions.end(), {a, b, c});
    shape.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return shape;
}

}  // namespace limber::eval::test
