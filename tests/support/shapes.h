// SPDX-License-Identifier: Apache-2.0
// Small surfaces of known shape, and random numbers that are the same everywhere.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "tests/support/grid.h"

namespace limber::test {

struct Shape {
  Mesh mesh;
  std::vector<Vec3f> positions;
};

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15u + 0x2545f4914f6cdd1du) {}

  std::uint32_t below(std::uint32_t end) {
    state_ ^= state_ << 13, state_ ^= state_ >> 7, state_ ^= state_ << 17;
    return static_cast<std::uint32_t>(((state_ >> 32) * end) >> 32);
  }
  // In [-1, 1).
  float unit() { return static_cast<float>(below(1u << 24)) / static_cast<float>(1u << 23) - 1; }
  Vec3f point() {
    const float x = unit(), y = unit(), z = unit();
    return {x, y, z};
  }

 private:
  std::uint64_t state_;
};

template <class Move>
Shape moved(Shape shape, const Move& move) {
  for (Vec3f& p : shape.positions) p = move(p);
  return shape;
}

// Every coordinate up to `amount` off.
inline Shape jittered(const Shape& shape, float amount, std::uint64_t seed) {
  Random random(seed);
  return moved(shape, [&](Vec3f p) { return p + random.point() * amount; });
}

// Every coordinate a multiple of 1/steps: what a translation by a power of two leaves exact.
inline Shape quantized(const Shape& shape, float steps) {
  const auto round = [steps](float x) { return std::round(x * steps) / steps; };
  return moved(shape, [&](Vec3f p) { return Vec3f{round(p.x), round(p.y), round(p.z)}; });
}

// A flat sheet of columns x rows vertices, one unit apart, in the plane z = 0, facing +z. `keep(x, y)` says which of
// its squares are there.
template <class Keep>
Shape sheet(Index columns, Index rows, const Keep& keep) {
  Shape s{grid(columns, rows), {}};
  for (Index y = 0; y < rows; ++y) {
    for (Index x = 0; x < columns; ++x) s.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
  }
  std::erase_if(s.mesh.triangles, [&](const Triangle& t) { return !keep(t[0] % columns, t[0] / columns); });
  return s;
}

inline Shape sheet(Index columns, Index rows) {
  return sheet(columns, rows, [](Index, Index) { return true; });
}

// A sheet with a rectangular hole in its middle third: an annulus.
inline Shape sheet_with_hole(Index columns, Index rows) {
  return sheet(columns, rows, [=](Index x, Index y) {
    return x < columns / 3 || x >= 2 * columns / 3 || y < rows / 3 || y >= 2 * rows / 3;
  });
}

inline Shape waved(const Shape& flat) {
  return moved(flat, [](Vec3f p) { return Vec3f{p.x, p.y, std::sin(0.7f * p.x) + std::cos(0.9f * p.y)}; });
}

inline Shape tetrahedron() {
  Shape shape;
  shape.mesh.vertex_count = 4;
  shape.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  shape.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return shape;
}

inline Shape octahedron() {
  Shape shape;
  shape.mesh.vertex_count = 6;
  shape.mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  shape.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  return shape;
}

// Every triangle cut into four.
inline Shape subdivided(const Shape& coarse) {
  Shape fine{{coarse.mesh.vertex_count, {}}, coarse.positions};
  std::map<std::pair<Index, Index>, Index> middle_of;
  const auto middle = [&](Index a, Index b) {
    const auto [at, is_new] = middle_of.try_emplace(std::minmax(a, b), fine.mesh.vertex_count);
    if (is_new) ++fine.mesh.vertex_count, fine.positions.push_back((coarse.positions[a] + coarse.positions[b]) * 0.5f);
    return at->second;
  };
  for (const auto& [a, b, c] : coarse.mesh.triangles) {
    const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.mesh.triangles.push_back(t);
  }
  return fine;
}

// An octahedron cut `depth` times.
inline Shape cut_octahedron(int depth) { return depth == 0 ? octahedron() : subdivided(cut_octahedron(depth - 1)); }

// The same blown up to the unit sphere: 4^(depth + 1) + 2 vertices.
inline Shape sphere(int depth) {
  return moved(cut_octahedron(depth), [](Vec3f p) { return p * (1 / length(p)); });
}

// A closed torus of around x along vertices, both at least 3.
inline Shape torus(Index around, Index along) {
  Shape s;
  s.mesh.vertex_count = around * along;
  for (Index j = 0; j < along; ++j) {
    for (Index i = 0; i < around; ++i) {
      const float u = 6.2831853f * static_cast<float>(i) / static_cast<float>(around);
      const float v = 6.2831853f * static_cast<float>(j) / static_cast<float>(along);
      s.positions.push_back({(3 + std::cos(u)) * std::cos(v), (3 + std::cos(u)) * std::sin(v), std::sin(u)});
      const Index a = j * around + i, b = j * around + (i + 1) % around;
      const Index c = (j + 1) % along * around + i, d = (j + 1) % along * around + (i + 1) % around;
      s.mesh.triangles.push_back({a, d, b});
      s.mesh.triangles.push_back({a, c, d});
    }
  }
  return s;
}

// Both, side by side: `second` is numbered after `first` and stands `apart` along x from where it was.
inline Shape together(Shape first, const Shape& second, float apart) {
  for (Triangle t : second.mesh.triangles) {
    for (Index& corner : t) corner += first.mesh.vertex_count;
    first.mesh.triangles.push_back(t);
  }
  for (const Vec3f& p : second.positions) first.positions.push_back(p + Vec3f{apart, 0, 0});
  first.mesh.vertex_count += second.mesh.vertex_count;
  return first;
}

}  // namespace limber::test
