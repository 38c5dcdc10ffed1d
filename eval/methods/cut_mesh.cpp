// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/cut_mesh.h"

#include "eval/methods/thread_time.h"

namespace limber::eval {

CutMesh::CutMesh(const Mesh& mesh, const Hierarchy& hierarchy, const CutOptions& cut)
    : mesh_(mesh), cut_(mesh, hierarchy, cut) {}

void CutMesh::frame(const FrameState& state, Approximation& out) {
  const ThreadTimer extracting;
  cut_.update(mesh_, state);
  extract(mesh_, state, cut_, scratch_, buffers_);
  out.extract_seconds = extracting.seconds();

  out.positions = buffers_.positions;
  out.nodes = buffers_.nodes;
  out.triangles.resize(buffers_.triangle_count());
  for (std::size_t t = 0; t < out.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) out.triangles[t][k] = buffers_.indices[3 * t + k];
  }
  out.clusters.assign(cut_.labels().begin(), cut_.labels().begin() + mesh_.vertex_count);
}

CutOptions cut_to_size(const MethodOptions& options) {
  return options.vertices > 0 ? CutOptions{.by = CutBy::kVertices, .budget = options.vertices}
                              : CutOptions{.by = CutBy::kTriangles, .budget = options.triangles};
}

}  // namespace limber::eval
