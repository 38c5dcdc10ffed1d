// SPDX-License-Identifier: Apache-2.0
// The edges of a mesh, each once.
#pragma once

#include <array>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

// Edges of the triangles with three different corners; others have none. Sorted by (smaller end, first triangle
// that has it), the same for the same mesh.
struct Edges {
  std::vector<std::array<Index, 2>> ends;  // [edge_count], smaller index first
  std::vector<Index> triangle_count;       // [edge_count], triangles on the edge: 1 on a border, 2 inside, else more
  std::vector<Index> some_triangle;        // [edge_count], the first triangle on it
};

Edges find_edges(const Mesh& mesh);

}  // namespace limber
