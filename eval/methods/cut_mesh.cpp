// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/cut_mesh.h"

#include "eval/methods/thread_time.h"

namespace limber::eval {

CutMesh::CutMesh(const Mesh& mesh, const Hierarchy& hierarchy, const CutOptions& cut, Index blend)
    : mesh_(mesh), cut_(mesh, hierarchy, cut) {
  if (blend > 1) blend_.emplace(mesh, hierarchy, BlendOptions{.frames = blend});
}

void CutMesh::frame(const FrameState& state, Approximation& out) {
  const ThreadTimer extracting;
  cut_.update(mesh_, state);
  if (blend_) {
    blend_->update(state, cut_);
    extract(mesh_, *blend_, scratch_, buffers_);
  } else {
    extract(mesh_, state, cut_, scratch_, buffers_);
  }
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
