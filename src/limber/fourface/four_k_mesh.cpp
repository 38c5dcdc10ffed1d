// SPDX-License-Identifier: Apache-2.0
#include "limber/fourface/four_k_mesh.h"

#include <algorithm>
#include <cassert>

namespace limber {
namespace {

Index count_vertices(const FourKMesh& mesh) {
  std::vector<bool> used(mesh.vertex_count, false);
  Index count = 0;
  for (Index t = 0; t < mesh.finest_count; ++t) {
    for (const Index corner : mesh.triangles[t]) {
      if (!used[corner]) ++count;
      used[corner] = true;
    }
  }
  return count;
}

}  // namespace

std::size_t FourKMesh::byte_count() const {
  return triangles.size() * (sizeof(Triangle) + 2 * sizeof(Index)) +
         sizeof(Index) * (created_begin.size() + destroyed_begin.size() + destroyed.size() + vertex.size()) +
         sizeof(float) * (error.size() + radius.size());
}

FourKHeight height(const FourKMesh& mesh) {
  FourKHeight most;
  std::vector<FourKHeight> of(mesh.operation_count());
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    FourKHeight below;
    for (const Index t : mesh.destroyed_by(o)) {
      const Index c = mesh.creator[t];
      if (c == kNone) continue;
      below.operations = std::max(below.operations, of[c].operations);
      // A swap for the same vertex belongs to the same cluster.
      const bool same = mesh.vertex[c] == mesh.vertex[o] && !mesh.is_removal(c);
      below.clusters = std::max(below.clusters, same ? of[c].clusters - 1 : of[c].clusters);
    }
    of[o] = {below.operations + 1, below.clusters + 1};
    most = {std::max(most.operations, of[o].operations), std::max(most.clusters, of[o].clusters)};
  }
  return most;
}

std::vector<Triangle> triangles_after(const FourKMesh& mesh, Index operation_count) {
  assert(operation_count <= mesh.operation_count());
  const Index end = operation_count == 0 ? mesh.finest_count : mesh.created_begin[operation_count];
  std::vector<Triangle> left;
  for (Index t = 0; t < end; ++t)
    if (mesh.destroyer[t] == kNone || mesh.destroyer[t] >= operation_count) left.push_back(mesh.triangles[t]);
  return left;
}

Index operations_to_vertices(const FourKMesh& mesh, Index vertices) {
  Index count = count_vertices(mesh), operations = 0;
  for (; count > vertices && operations < mesh.operation_count(); ++operations)
    if (mesh.is_removal(operations)) --count;
  return operations;
}

Index operations_to_triangles(const FourKMesh& mesh, Index triangles) {
  Index count = mesh.finest_count, operations = 0;
  for (; count > triangles && operations < mesh.operation_count(); ++operations)
    count -= static_cast<Index>(mesh.destroyed_by(operations).size()) - mesh.created_count(operations);
  return operations;
}

}  // namespace limber
