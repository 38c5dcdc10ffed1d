// SPDX-License-Identifier: Apache-2.0
// The quadrics of the finest vertices in one frame.
#pragma once

#include <span>
#include <vector>

#include "limber/base/facing.h"
#include "limber/base/mesh.h"
#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/contract/edges.h"

namespace limber {

struct QuadricOptions {
  // Weight of the planes that hold open borders in place (Garland & Heckbert 1997, section 6), >= 0. Such a plane
  // stands on a border edge, perpendicular to its triangle, and counts as an area of the squared edge length.
  double border_weight = 1.0;
  // Weight of the squared distance to the vertex itself against that to its planes, > 0: what keeps every minimum
  // unique, in flat and folded regions too (docs/design.md, "Placement").
  double point_weight = 1e-5;
};

// A similarity that brings a frame near the origin and to about unit size, where the arithmetic of quadrics loses
// least: q = (p - center) x scale.
struct Normalization {
  Vec3d center;
  double scale = 1;

  Vec3d to_unit(const Vec3f& p) const { return (static_cast<Vec3d>(p) - center) * scale; }
  Vec3f from_unit(const Vec3d& q) const { return static_cast<Vec3f>(q * (1 / scale) + center); }
};

// The centre of the bounding box of `positions`; the scale is 1/diagonal, or 1 where that is not a finite number.
Normalization normalization(std::span<const Vec3f> positions);

// What is needed of the connectivity, found once per clip.
class VertexQuadrics {
 public:
  VertexQuadrics(const Mesh& mesh, const QuadricOptions& options) : VertexQuadrics(mesh, find_edges(mesh), options) {}
  // edges: find_edges(mesh).
  VertexQuadrics(const Mesh& mesh, const Edges& edges, const QuadricOptions& options);

  // One pass over the triangles: each gives a third of its area-weighted plane to each corner; border edges give
  // their planes to both ends; every vertex gets its own point, so that no minimum is ever singular.
  // positions: [vertex_count], normalized; quadrics: [vertex_count], overwritten.
  void compute(std::span<const Vec3d> positions, std::span<Quadric> quadrics);

  // [vertex_count]: a third of the triangles around each vertex, in the frame of the last compute().
  std::span<const Facing> facings() const { return facings_; }

 private:
  struct BorderEdge {
    Index from, to, triangle;
  };

  const std::vector<Triangle>& triangles_;
  QuadricOptions options_;
  std::vector<BorderEdge> border_edges_;
  std::vector<Facing> facings_;  // [vertex_count]
};

}  // namespace limber
