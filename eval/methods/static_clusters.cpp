// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/static_clusters.h"

#include "eval/methods/thread_time.h"

namespace limber::eval {

StaticClusters::StaticClusters(const Mesh& mesh, const Contractor& contractor, std::span<const Vec3f> first,
                               const QuadricOptions& quadrics)
    : mesh_(mesh),
      simplified_(simplified_mesh(contractor, mesh, 0)),
      scale_(normalization(first).scale),
      clusters_(mesh.vertex_count),
      cluster_of_(mesh.vertex_count),
      member_count_(simplified_.vertices.size()),
      vertex_quadrics_(mesh, quadrics),
      unit_(mesh.vertex_count),
      quadrics_(mesh.vertex_count),
      sums_(simplified_.vertices.size()) {
  std::vector<Index> index_of(mesh.vertex_count, kNone);
  for (Index i = 0; i < size(); ++i) index_of[simplified_.vertices[i]] = i;
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    clusters_[v] = contractor.representative(v);
    cluster_of_[v] = index_of[clusters_[v]];
    if (cluster_of_[v] != kNone) ++member_count_[cluster_of_[v]];
  }
}

std::span<const Quadric> StaticClusters::sum_quadrics(std::span<const Vec3f> positions, Normalization& normalize) {
  normalize = {normalization(positions).center, scale_};
  for (Index v = 0; v < mesh_.vertex_count; ++v) unit_[v] = normalize.to_unit(positions[v]);
  vertex_quadrics_.compute(unit_, quadrics_);
  sums_.assign(size(), Quadric{});
  for (Index v = 0; v < mesh_.vertex_count; ++v) {
    if (cluster_of_[v] != kNone) sums_[cluster_of_[v]] += quadrics_[v];
  }
  return sums_;
}

void StaticClusters::connect(Approximation& out) const {
  const ThreadTimer extracting;
  out.triangles = simplified_.mesh.triangles;
  out.nodes = simplified_.vertices;
  out.extract_seconds = extracting.seconds();
  out.clusters = clusters_;
}

void StaticClusters::frame(std::span<const Vec3f> positions, Approximation& out) {
  const ThreadTimer adapting;
  Normalization normalize;
  sum_quadrics(positions, normalize);
  out.positions.resize(size());
  for (Index i = 0; i < size(); ++i) {
    // As the contraction has it: what nothing was contracted into stays where it is.
    out.positions[i] =
        member_count_[i] == 1 ? positions[simplified_.vertices[i]] : normalize.from_unit(minimum(sums_[i]).point);
  }
  out.adapt_seconds = adapting.seconds();
  connect(out);
}

}  // namespace limber::eval
