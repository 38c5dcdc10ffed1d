// SPDX-License-Identifier: Apache-2.0
// Where the readers of mesh files put what they find.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

// Collects the triangles of a first frame, or compares those of a later frame with the first while they are read,
// so that no second mesh is ever held. Polygons are cut into fans, (0 1 2) (0 2 3) ...: the same for every frame,
// whatever its positions.
class MeshSink {
 public:
  // A triangle of a later frame that is not that of the first.
  struct Difference {
    std::uint64_t triangle = 0;
    Triangle corners{};
  };

  // Both clear what they collect into; what they are given must outlive the sink.
  static MeshSink collecting(std::vector<Vec3f>& positions, std::vector<Triangle>& triangles) {
    triangles.clear();
    return MeshSink(positions, &triangles, {});
  }
  static MeshSink comparing(std::vector<Vec3f>& positions, std::span<const Triangle> expected) {
    return MeshSink(positions, nullptr, expected);
  }

  // Room for what a file promises; the caller has checked that the file is long enough to hold it.
  void reserve(std::size_t vertex_count, std::size_t triangle_count) {
    positions_.reserve(vertex_count);
    if (triangles_) triangles_->reserve(triangle_count);
  }

  void add_vertex(const Vec3f& position) { positions_.push_back(position); }

  // A face of fewer than three corners has no triangles.
  void add_face(std::span<const Index> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) add_triangle({corners[0], corners[i - 1], corners[i]});
  }

  std::uint64_t vertex_count() const { return positions_.size(); }
  std::uint64_t triangle_count() const { return triangle_count_; }

  // The first triangle that differs, among as many as both meshes have.
  const std::optional<Difference>& difference() const { return difference_; }

 private:
  MeshSink(std::vector<Vec3f>& positions, std::vector<Triangle>* triangles, std::span<const Triangle> expected)
      : positions_(positions), triangles_(triangles), expected_(expected) {
    positions.clear();
  }

  void add_triangle(const Triangle& corners) {
    if (triangles_) {
      triangles_->push_back(corners);
    } else if (!difference_ && triangle_count_ < expected_.size() && expected_[triangle_count_] != corners) {
      difference_ = Difference{triangle_count_, corners};
    }
    ++triangle_count_;
  }

  std::vector<Vec3f>& positions_;
  std::vector<Triangle>* triangles_;  // null: compare
  std::span<const Triangle> expected_;
  std::uint64_t triangle_count_ = 0;
  std::optional<Difference> difference_;
};

}  // namespace limber
