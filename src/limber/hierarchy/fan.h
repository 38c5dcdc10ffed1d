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

// Seen from the node and in single precision: rounding is relative to the length of the edges. Keeps its memory from
// node to node.
class Fan {
 public:
  // A point on a triangle, and the way from there to the point asked for: direction x steps.
  struct Place {
    Index a, b;        // the triangle's corners beside the node
    float at_a, at_b;  // barycentric, >= 0; what is left of 1 is the node's
    Vec3f direction;   // of the triangle's normal where the point is right above it, of any length
    float by_squared;  // 1 / its squared length
    float steps;
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

  // The closest point; or, when the point is nearly in a triangle's plane and above it (kSteep), the closest of the
  // points that it is right above or below. Precondition: not empty.
  Place closest(const Vec3f& point) const;

 private:
  struct Vector4 {
    Float4 x, y, z;
  };

  // Four triangles, the last ones of a fan perhaps with all corners at the node.
  struct Block {
    Vector4 a, b;            // the ways to the corners
    Vector4 normal;          // a x b
    Vector4 dual_a, dual_b;  // their products with a point are its barycentric coordinates
    Float4 limit;            // of the sum of these: 1, or -1 where there is no area
    Float4 by_squared;       // reciprocal of the squared length of the normal, 0 where there is no area
  };

  static Float4 dots(const Vector4& u, const Vector4& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
  static Vector4 crosses(const Vector4& u, const Vector4& v) {
    return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  }
  static Vec3f extract(const Vector4& v, unsigned lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }
  void grow();
  static void prepare(Block& block);
  // a / b between 0 and 1; 0 where b is none.
  static Float4 clamped_ratio(Float4 a, Float4 b) {
    const Float4 ratio = ((a > 0) & (b > 0)) ? a / b : Float4{};
    return ratio < 1 ? ratio : Float4{} + 1;
  }
  // A triangle that a place is on, kNone where there is none.
  struct Found {
    Index triangle;
    float squared;  // distance, or gain: by how much it is less than that to the node
    float at_a, at_b;
  };
  inline Found find_below(const Vector4& point) const;
  Found find_on_sides(const Vector4& point) const;

  std::vector<Block> blocks_;
  std::vector<Index> corners_;  // a and b of each triangle
  unsigned size_ = 0;           // triangles
};

}  // namespace limber
