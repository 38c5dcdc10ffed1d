// SPDX-License-Identifier: Apache-2.0
// The one-rings of a mesh as offsets and data. Part of the player.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"

namespace limber {

// Lists of indices, one after another.
struct IndexLists {
  std::vector<Index> begin;  // [list_count + 1]
  std::vector<Index> data;   // [begin.back()]

  std::span<const Index> operator[](Index i) const {
    return std::span(data).subspan(begin[i], begin[i + 1] - begin[i]);
  }
};

// For each vertex the triangles that have it as a corner, ascending; a triangle that repeats it is there once.
IndexLists incident_triangles(const Mesh& mesh);

// For each vertex the vertices with which it shares an edge: each once, never itself, in the order in which its
// triangles name them.
IndexLists neighbors(const Mesh& mesh, const IndexLists& incident);

}  // namespace limber
