// SPDX-License-Identifier: Apache-2.0
// Vertices renumbered so that neighbours in space are neighbours in memory.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

struct SpatialMesh {
  std::vector<Index> order;   // [vertex_count]: the input's vertex that stands at each place
  std::vector<Index> places;  // [vertex_count]: the inverse
  Mesh mesh;                  // corners are places; triangles stand by their first corner
};

// The vertices along a Z-order curve (Morton 1966) through a grid of 1024 cells a side on their bounding box, vertices
// of one cell by index. positions: [vertex_count], finite.
SpatialMesh in_spatial_order(const Mesh& mesh, std::span<const Vec3f> positions);

}  // namespace limber
