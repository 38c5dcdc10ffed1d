// SPDX-License-Identifier: Apache-2.0
// Vertices renumbered so that neighbours in space are neighbours in memory.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

// The vertices along a Z-order curve (Morton 1966) through a grid of 1024 cells a side on their bounding box, vertices
// of one cell by index: the vertex that stands at each place. Positions finite.
std::vector<Index> spatial_order(std::span<const Vec3f> positions);

// The mesh with vertex order[i] called i. Triangles keep their corners' order and stand by the first corner.
// `places`, overwritten, is the inverse of `order`.
Mesh renumbered(const Mesh& mesh, std::span<const Index> order, std::vector<Index>& places);

}  // namespace limber
