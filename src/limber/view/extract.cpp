// SPDX-License-Identifier: Apache-2.0
//   list_triangles                         the cut's triangles, as node ids
//   number_vertices                        the nodes in use, in rising order, become vertices
//   positions, indices                     fetched through that numbering
//   smooth_normals
#include "limber/view/extract.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace limber {

namespace {

bool is_finest_level(const Mesh& mesh, const Cut& cut) {
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    if (!cut.is_active(v)) return false;
  }
  return true;
}

void number_vertices(const TriangleList& list, std::size_t node_count, std::vector<Index>& vertex_of_node,
                     std::vector<Index>& nodes) {
  vertex_of_node.assign(node_count, kNone);
  Index used = 0;
  for (const Triangle& t : list.triangles) {
    for (const Index node : t) {
      used += vertex_of_node[node] == kNone;
      vertex_of_node[node] = 0;
    }
  }
  nodes.resize(used);
  Index vertex = 0;
  for (Index node = 0; vertex < used; ++node) {
    if (vertex_of_node[node] == kNone) continue;
    vertex_of_node[node] = vertex;
    nodes[vertex++] = node;
  }
}

void take_input(const Mesh& mesh, MeshBuffers& buffers, ExtractScratch& scratch) {
  scratch.list.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  scratch.list.faces.resize(mesh.triangles.size());
  std::iota(scratch.list.faces.begin(), scratch.list.faces.end(), Index{0});
  buffers.nodes.resize(mesh.vertex_count);
  std::iota(buffers.nodes.begin(), buffers.nodes.end(), Index{0});
  std::copy(buffers.nodes.begin(), buffers.nodes.end(), scratch.vertex_of_node.begin());
}

}  // namespace

void smooth_normals(std::span<const Vec3f> positions, std::span<const Index> indices, std::vector<Vec3d>& sums,
                    std::vector<Vec3f>& normals) {
  assert(indices.size() % 3 == 0);
  sums.assign(positions.size(), Vec3d{});
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const Vec3d a(positions[indices[i]]), b(positions[indices[i + 1]]), c(positions[indices[i + 2]]);
    const Vec3d normal = cross(b - a, c - a);
    for (std::size_t corner = i; corner < i + 3; ++corner) sums[indices[corner]] += normal;
  }
  normals.resize(positions.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double norm = length(sums[v]);
    normals[v] = norm > 0 ? Vec3f(sums[v] * (1 / norm)) : Vec3f{0, 0, 1};
  }
}

void extract(const Mesh& mesh, const FrameState& state, const Cut& cut, ExtractScratch& scratch, MeshBuffers& buffers,
             const ExtractOptions& options) {
  assert(state.positions.size() == cut.labels().size());
  if (options.whole_input && is_finest_level(mesh, cut)) {
    scratch.vertex_of_node.assign(state.positions.size(), kNone);
    take_input(mesh, buffers, scratch);
  } else {
    list_triangles(mesh, cut, scratch.list);
    number_vertices(scratch.list, state.positions.size(), scratch.vertex_of_node, buffers.nodes);
  }
  buffers.positions.resize(buffers.nodes.size());
  for (std::size_t v = 0; v < buffers.nodes.size(); ++v) buffers.positions[v] = state.positions[buffers.nodes[v]];
  buffers.indices.resize(3 * scratch.list.triangles.size());
  auto next = buffers.indices.begin();
  for (const Triangle& t : scratch.list.triangles) {
    for (const Index node : t) *next++ = scratch.vertex_of_node[node];
  }
  smooth_normals(buffers.positions, buffers.indices, scratch.normal_sums, buffers.normals);
}

}  // namespace limber
