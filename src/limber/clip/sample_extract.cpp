// SPDX-License-Identifier: Apache-2.0
// Marching tetrahedra. Each cube of the grid is cut into the six tetrahedra around its diagonal, one for each order
// of the axes; neighbouring cubes then agree on the diagonals of their faces, so the surface closes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "limber/clip/sample_surface.h"

namespace limber {
namespace {

constexpr int kBlock = 8;  // cells along an edge of a block that is skipped as a whole where the surface is far

struct Grid {
  Vec3d origin;
  double spacing = 0.0;
  std::array<int, 3> nodes{};  // along each axis

  std::uint64_t id(int x, int y, int z) const {
    return (static_cast<std::uint64_t>(z) * static_cast<std::uint64_t>(nodes[1]) + static_cast<std::uint64_t>(y)) *
               static_cast<std::uint64_t>(nodes[0]) +
           static_cast<std::uint64_t>(x);
  }
  Vec3d point(int x, int y, int z) const { return origin + Vec3d{x * spacing, y * spacing, z * spacing}; }
};

struct Corner {
  std::uint64_t node = 0;
  int bits = 0;  // which way from the cube's low corner, one bit per axis
  Vec3d point;
  double value = 0.0;
};

class Extraction {
 public:
  explicit Extraction(SurfaceMesh& out) : out_(out) {}

  void add_tetrahedron(const std::array<Corner, 4>& corners) {
    std::array<int, 4> inside{}, outside{};
    std::size_t inside_count = 0, outside_count = 0;
    for (int i = 0; i < 4; ++i) {
      const bool in = corners[static_cast<std::size_t>(i)].value < 0.0;
      (in ? inside[inside_count++] : outside[outside_count++]) = i;
    }
    if (inside_count == 0 || outside_count == 0) return;
    const auto cut = [&](int i, int o) {
      return vertex(corners[static_cast<std::size_t>(i)], corners[static_cast<std::size_t>(o)]);
    };
    const Vec3d& within = corners[static_cast<std::size_t>(inside[0])].point;
    if (inside_count == 1) {
      add_triangles({cut(inside[0], outside[0]), cut(inside[0], outside[1]), cut(inside[0], outside[2]), kNone},
                    within);
    } else if (inside_count == 3) {
      add_triangles({cut(inside[0], outside[0]), cut(inside[1], outside[0]), cut(inside[2], outside[0]), kNone},
                    within);
    } else {
      add_triangles({cut(inside[0], outside[0]), cut(inside[0], outside[1]), cut(inside[1], outside[1]),
                     cut(inside[1], outside[0])},
                    within);
    }
  }

 private:
  // The vertex on the grid edge between two corners, one of which is "below" the other in every axis.
  Index vertex(const Corner& p, const Corner& q) {
    const Corner& low = p.bits < q.bits ? p : q;
    const std::uint64_t key = low.node * 8 + static_cast<std::uint64_t>(p.bits ^ q.bits);
    const auto [entry, is_new] = vertices_.try_emplace(key, static_cast<Index>(out_.positions.size()));
    if (is_new) {
      const Corner& high = p.bits < q.bits ? q : p;
      // Kept off the corners, so that no triangle degenerates.
      const double t = std::clamp(low.value / (low.value - high.value), 0.05, 0.95);
      out_.positions.push_back(low.point + (high.point - low.point) * t);
    }
    return entry->second;
  }

  void add_triangles(std::array<Index, 4> polygon, const Vec3d& within) {
    const std::vector<Vec3d>& x = out_.positions;
    const Vec3d normal = cross(x[polygon[1]] - x[polygon[0]], x[polygon[2]] - x[polygon[0]]);
    const bool turn = dot(normal, within - x[polygon[0]]) > 0.0;
    const auto add = [&](Index a, Index b, Index c) {
      out_.mesh.triangles.push_back(turn ? Triangle{a, c, b} : Triangle{a, b, c});
    };
    add(polygon[0], polygon[1], polygon[2]);
    if (polygon[3] != kNone) add(polygon[0], polygon[2], polygon[3]);
  }

  SurfaceMesh& out_;
  std::unordered_map<std::uint64_t, Index> vertices_;
};

void add_cell(const Grid& grid, const std::array<int, 3>& cell, const std::array<double, 8>& values, Extraction& to) {
  std::array<Corner, 8> corners;
  for (int bits = 0; bits < 8; ++bits) {
    const int x = cell[0] + (bits & 1), y = cell[1] + ((bits >> 1) & 1), z = cell[2] + ((bits >> 2) & 1);
    corners[static_cast<std::size_t>(bits)] = {grid.id(x, y, z), bits, grid.point(x, y, z),
                                               values[static_cast<std::size_t>(bits)]};
  }
  constexpr std::array<std::array<std::size_t, 2>, 6> kPaths = {{{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}}};
  for (const auto& [first, second] : kPaths) {
    to.add_tetrahedron({corners[0], corners[first], corners[second], corners[7]});
  }
}

}  // namespace

SurfaceMesh extract_surface(const BodySurface& surface, double spacing) {
  const Box& box = surface.body.bounds();
  Grid grid{.origin = box.low - Vec3d{spacing, spacing, spacing} * 2.0, .spacing = spacing};
  const Vec3d extent = box.high - box.low;
  const std::array<double, 3> extents{extent.x, extent.y, extent.z};
  std::array<int, 3> blocks{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    blocks[axis] = static_cast<int>(std::ceil((extents[axis] / spacing + 4.0) / kBlock));
    grid.nodes[axis] = blocks[axis] * kBlock + 1;
  }

  SurfaceMesh result;
  Extraction extraction(result);
  constexpr std::size_t kSide = kBlock + 1;
  std::vector<double> values(kSide * kSide * kSide);
  for (int bz = 0; bz < blocks[2]; ++bz) {
    for (int by = 0; by < blocks[1]; ++by) {
      for (int bx = 0; bx < blocks[0]; ++bx) {
        const std::array<int, 3> low{bx * kBlock, by * kBlock, bz * kBlock};
        const Vec3d half{0.5 * kBlock * spacing, 0.5 * kBlock * spacing, 0.5 * kBlock * spacing};
        // The value falls by at most about 1.6 per unit of length, and less than 2.
        if (std::fabs(surface.distance(grid.point(low[0], low[1], low[2]) + half)) > 2.0 * length(half)) continue;
        for (std::size_t i = 0; i < values.size(); ++i) {
          const int x = static_cast<int>(i % kSide), y = static_cast<int>(i / kSide % kSide),
                    z = static_cast<int>(i / (kSide * kSide));
          values[i] = surface.distance(grid.point(low[0] + x, low[1] + y, low[2] + z));
        }
        for (int i = 0; i < kBlock * kBlock * kBlock; ++i) {
          const std::array<int, 3> cell{i % kBlock, i / kBlock % kBlock, i / (kBlock * kBlock)};
          std::array<double, 8> corner_values;
          for (std::size_t bits = 0; bits < 8; ++bits) {
            const std::size_t x = static_cast<std::size_t>(cell[0]) + (bits & 1);
            const std::size_t y = static_cast<std::size_t>(cell[1]) + ((bits >> 1) & 1);
            const std::size_t z = static_cast<std::size_t>(cell[2]) + ((bits >> 2) & 1);
            corner_values[bits] = values[(z * kSide + y) * kSide + x];
          }
          add_cell(grid, {low[0] + cell[0], low[1] + cell[1], low[2] + cell[2]}, corner_values, extraction);
        }
      }
    }
  }
  result.mesh.vertex_count = static_cast<Index>(result.positions.size());
  return result;
}

}  // namespace limber
