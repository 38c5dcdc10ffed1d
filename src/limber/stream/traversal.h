// SPDX-License-Identifier: Apache-2.0
// The order in which the positions of the finest vertices are coded, and for each vertex those coded before it
// from which it is predicted. Follows from the connectivity alone. Part of the player.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/stream/neighbors.h"

namespace limber {

// No vertex is predicted from more than this many others.
inline constexpr Index kMostSources = 8;

// Weights of sources are in 1/256.
inline constexpr int kWeightBits = 8;

// A place is a position in the order. Vertices are numbered by their places wherever positions are coded.
struct Traversal {
  std::vector<Index> order;  // [vertex_count]: the vertex at each place
  std::vector<Index> place;  // [vertex_count]: the place of each vertex
  // For each place, earlier ones: first neighbours, then the far corners of the triangles across the edges that
  // face the vertex. Places without any have the place before as their only source; place 0 has none.
  IndexLists sources;
  std::vector<std::int16_t> key_weights;  // [sources.data.size()]: predict a position where nothing is known of
                                          // the past; they sum to 256 at each place
};

// Next comes always a vertex with the most neighbours that are placed (more than seven count as seven), the one
// that got that many first; where none has any, the lowest.
Traversal traverse(const Mesh& mesh, const IndexLists& incident, const IndexLists& neighbors);

}  // namespace limber
