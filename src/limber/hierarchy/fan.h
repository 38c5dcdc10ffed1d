// SPDX-License-Identifier: Apache-2.0
// The triangles around a node, and the points on them that are closest to others: what a level fit asks most often.
#pragma once

#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

// Four numbers at once, to the same result on every processor.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

// Four vectors.
struct Vector4 {
  Float4 x, y, z;
};

// Seen from the node and in single precision: rounding is relative to the length of the edges. Keeps its memory from
// node to node.
class Fan {
 public:
  // For each of four points one on a triangle, and the way from there to it: direction x steps.
  struct Places {
    Index a[4], b[4];   // the triangle's corners beside the node
    Float4 at_a, at_b;  // barycentric, >= 0; what is left of 1 is the node's
    Vector4 direction;  // of the triangle's normal where the point is right above it, of any length
    Float4 by_squared;  // 1 / its squared length
    Float4 steps;
  };

  void clear() { size_ = 0; }
  bool empty() const { return size_ == 0; }
  // A triangle: the corners beside the node, and the ways there from the node.
  void add(Index a, const Vec3f& to_a, Index b, const Vec3f& to_b) {
    const unsigned lane = size_ % 4;
    if (size_ == 4 * blocks_.size()) grow();
    Block& block = blocks_[size_ / 4];
    if (lane == 0) block.a = Vector4{}, block.b = Vector4{};
    block.a.x[lane] = to_a.x, block.a.y[lane] = to_a.y, block.a.z[lane] = to_a.z;
    block.b.x[lane] = to_b.x, block.b.y[lane] = to_b.y, block.b.z[lane] = to_b.z;
    corners_[2 * size_] = a, corners_[2 * size_ + 1] = b;
    ++size_;
  }
  // To be called between the last add() and the first closest().
  void finish();

  // The closest points; or, when a point is nearly in a triangle's plane and above it (kSteep), the closest of those
  // that it is right above or below. The node itself is on its triangles. Precondition: not empty.
  Places closest(const Vector4& points) const;

 private:
  // Four triangles, the last ones of a fan perhaps with all corners at the node.
  struct Block {
    Vector4 a, b;  // the ways to the corners
  };

  // A triangle, each number four times.
  struct Facet {
    Vector4 normal;          // a x b
    Vector4 dual_a, dual_b;  // their products with a point are its barycentric coordinates
    Float4 limit;            // of the sum of these: 1, or -1 where there is no area
    Float4 by_squared;       // reciprocal of the squared length of the normal, 0 where there is no area
  };

  // A place on the sides of triangles.
  struct Side {
    Index triangle;
    float gain;  // by how much the squared distance is less than that to the node
    float at_a, at_b;
  };

  void grow();
  void prepare(unsigned block);
  Side find_on_sides(const Vector4& point) const;
  void move_to_side(Places& places, unsigned lane, const Vector4& points, float below) const;

  std::vector<Block> blocks_;
  std::vector<Facet> facets_;   // of all triangles in the blocks
  std::vector<Index> corners_;  // a and b of each triangle
  unsigned size_ = 0;           // triangles
};

}  // namespace limber
