// SPDX-License-Identifier: Apache-2.0
// From a cut, or a blend, to a mesh ready to draw or to write.
// Part of the player: standard library only.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/stream/frame_state.h"
#include "limber/view/blend.h"
#include "limber/view/cut.h"
#include "limber/view/mesh_buffers.h"
#include "limber/view/triangle_list.h"

namespace limber {

struct ExtractOptions {
  // Where every active node is a finest vertex: give the input mesh as it was, with all its vertices in their order,
  // isolated ones too, and all its triangles, degenerate ones too. Otherwise, and in any coarser cut, vertices of
  // no triangle and degenerate triangles are left out.
  bool whole_input = false;
};

// Lives between frames so that nothing is allocated for each.
struct ExtractScratch {
  TriangleList list;                  // of the last extract()
  std::vector<Index> vertex_of_node;  // [node_count], of a blend also moving vertices: kNone where one is no vertex
                                      // of the buffers
  std::vector<Vec3d> normal_sums;     // [vertex_count of the buffers]
  std::vector<Vec3d> taken_sums;      // [node_count], of a blend
};

// Fills the buffers with the triangles of list_triangles(), in the same order. A vertex's normal is the sum of its
// triangles' normals weighted by their area; where that is nothing (all of them degenerate) it is (0, 0, 1).
// Allocates only where buffers and scratch have not been as large before.
// Precondition: cut.update(mesh, state) was the last call on the cut.
void extract(const Mesh& mesh, const FrameState& state, const Cut& cut, ExtractScratch& scratch, MeshBuffers& buffers,
             const ExtractOptions& options = {});

// The same of a blend, whose moving vertices come last, in the order of their numbers. Normals are blended as
// positions are: while a moving vertex is where it began, or where it ends, it has one normal with the node that is
// there. Precondition: blend.update(state, cut) has been called.
void extract(const Mesh& mesh, const Blend& blend, ExtractScratch& scratch, MeshBuffers& buffers,
             const ExtractOptions& options = {});

// The smooth normals of any triangle mesh, as above. `sums` is scratch.
// Preconditions: indices are below positions.size(); positions are finite.
void smooth_normals(std::span<const Vec3f> positions, std::span<const Index> indices, std::vector<Vec3d>& sums,
                    std::vector<Vec3f>& normals);

}  // namespace limber
