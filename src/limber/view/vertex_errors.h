// SPDX-License-Identifier: Apache-2.0
// How far the vertices of a cut are from the surface they stand for.
// Part of the player: standard library only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/stream/frame_state.h"
#include "limber/view/cut.h"

namespace limber {

struct VertexErrors {
  std::vector<float> of_vertex;  // [nodes.size()]: root mean square distance over the area that the node stands for, a
                                 // third of each finest triangle going to each corner; 0 where that has no area
  float all = 0;                 // the same over the area of all of them

  std::vector<double> area;              // [node_count]: scratch
  std::vector<std::uint8_t> is_counted;  // [node_count]: scratch
};

// `nodes`: active nodes (MeshBuffers::nodes); one that is there several times counts once in `all`. Distances in units
// of the input. Allocates only where there have not been as many nodes before. Precondition: cut.update(mesh, state)
// was the last call on the cut.
void measure_errors(const Mesh& mesh, const FrameState& state, const Cut& cut, std::span<const Index> nodes,
                    VertexErrors& errors);

}  // namespace limber
