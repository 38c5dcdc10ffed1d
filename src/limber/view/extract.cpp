// SPDX-License-Identifier: Apache-2.0
//   list_triangles                         of the cut or of the blend, as node ids
//   number_vertices                        the nodes in use, in rising order, become vertices
//   positions, indices                     fetched through that numbering
//   smooth_normals                         of a blend: shared between where a vertex begins and where it ends
#include "limber/view/extract.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace limber {

namespace {

bool is_finest_level(const Mesh& mesh, std::span<const Index> labels) {
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    if (labels[v] != v) return false;
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

// Triangles and positions: all but the normals. The labels name positions.
void fetch(const Mesh& mesh, std::span<const Index> labels, std::span<const Vec3f> positions, ExtractScratch& scratch,
           MeshBuffers& buffers, const ExtractOptions& options) {
  if (options.whole_input && is_finest_level(mesh, labels)) {
    scratch.vertex_of_node.assign(positions.size(), kNone);
    take_input(mesh, buffers, scratch);
  } else {
    list_triangles(mesh, labels, scratch.list);
    number_vertices(scratch.list, positions.size(), scratch.vertex_of_node, buffers.nodes);
  }
  buffers.positions.resize(buffers.nodes.size());
  for (std::size_t v = 0; v < buffers.nodes.size(); ++v) buffers.positions[v] = positions[buffers.nodes[v]];
  buffers.indices.resize(3 * scratch.list.triangles.size());
  auto next = buffers.indices.begin();
  for (const Triangle& t : scratch.list.triangles) {
    for (const Index node : t) *next++ = scratch.vertex_of_node[node];
  }
}

void sum_normals(std::span<const Vec3f> positions, std::span<const Index> indices, std::vector<Vec3d>& sums) {
  assert(indices.size() % 3 == 0);
  sums.assign(positions.size(), Vec3d{});
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    const Vec3d a(positions[indices[i]]), b(positions[indices[i + 1]]), c(positions[indices[i + 2]]);
    const Vec3d normal = cross(b - a, c - a);
    for (std::size_t corner = i; corner < i + 3; ++corner) sums[indices[corner]] += normal;
  }
}

// A node's sum takes in the shares that it has of moving vertices' sums; a moving vertex has the mean of the sums of
// the nodes that it is a mean of. So where it begins and where it ends normals are those of one vertex.
void blend_normals(const Blend& blend, ExtractScratch& scratch) {
  std::vector<Vec3d>&sums = scratch.normal_sums, &taken = scratch.taken_sums;
  const std::vector<Index>& vertex_of_node = scratch.vertex_of_node;
  const auto for_each_share = [&](auto visit) {
    for (Index i = 0; i < blend.path_count(); ++i) {
      const Index moving = vertex_of_node[blend.node_count() + i];
      if (moving == kNone) continue;
      for (const Blend::Share& share : blend.shares(i)) visit(moving, share.node, double{share.weight});
    }
  };
  taken.resize(blend.node_count());
  for_each_share([&](Index, Index node, double) { taken[node] = {}; });
  for_each_share([&](Index moving, Index node, double weight) { taken[node] += sums[moving] * weight; });
  for_each_share([&](Index moving, Index, double) { sums[moving] = {}; });
  for_each_share([&](Index moving, Index node, double weight) {
    sums[moving] += taken[node] * weight;
    if (vertex_of_node[node] != kNone) sums[moving] += sums[vertex_of_node[node]] * weight;
  });
  for_each_share([&](Index, Index node, double) {
    if (vertex_of_node[node] != kNone) sums[vertex_of_node[node]] += taken[node];
    taken[node] = {};
  });
}

void unit_normals(std::span<const Vec3d> sums, std::vector<Vec3f>& normals) {
  normals.resize(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double norm = length(sums[v]);
    normals[v] = norm > 0 ? Vec3f(sums[v] * (1 / norm)) : Vec3f{0, 0, 1};
  }
}

}  // namespace

void smooth_normals(std::span<const Vec3f> positions, std::span<const Index> indices, std::vector<Vec3d>& sums,
                    std::vector<Vec3f>& normals) {
  sum_normals(positions, indices, sums);
  unit_normals(sums, normals);
}

void extract(const Mesh& mesh, const FrameState& state, const Cut& cut, ExtractScratch& scratch, MeshBuffers& buffers,
             const ExtractOptions& options) {
  assert(state.positions.size() == cut.labels().size());
  fetch(mesh, cut.labels(), state.positions, scratch, buffers, options);
  smooth_normals(buffers.positions, buffers.indices, scratch.normal_sums, buffers.normals);
}

void extract(const Mesh& mesh, const Blend& blend, ExtractScratch& scratch, MeshBuffers& buffers,
             const ExtractOptions& options) {
  fetch(mesh, blend.labels(), blend.positions(), scratch, buffers, options);
  sum_normals(buffers.positions, buffers.indices, scratch.normal_sums);
  blend_normals(blend, scratch);
  unit_normals(scratch.normal_sums, buffers.normals);
}

}  // namespace limber
