// SPDX-License-Identifier: Apache-2.0
// A mesh ready to draw or to write.
// Part of the player: standard library only.
#pragma once

#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"

namespace limber {

// All but `indices` are [vertex_count] of this mesh, in rising order of node id.
struct MeshBuffers {
  std::vector<Vec3f> positions;  // in the units of the input
  std::vector<Vec3f> normals;    // of length 1, outwards where triangles are counter-clockwise seen from outside
  std::vector<Index> indices;    // [3 x triangle_count]
  std::vector<Index> nodes;  // the node of the hierarchy that each vertex is, or the label of a moving one (blend.h)

  Index vertex_count() const { return static_cast<Index>(nodes.size()); }
  Index triangle_count() const { return static_cast<Index>(indices.size() / 3); }
};

}  // namespace limber
