// SPDX-License-Identifier: Apache-2.0
// The clusters of the first frame for the whole clip: what Mohr & Gleicher 2003 call the naive approach, with the
// optimal position of every cluster in every frame.
//
//   begin:  contract the first frame; its clusters and triangles stay
//   frame:  quadrics of the vertices, summed over the clusters; a vertex where each sum is smallest
#include "eval/methods/contract_to_size.h"
#include "eval/methods/factories.h"
#include "eval/methods/thread_time.h"

namespace limber::eval {
namespace {

class FirstFrame final : public Method {
 public:
  explicit FirstFrame(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    mesh_ = &mesh;
    Contractor contractor(mesh, seen.first(1), options_.contract);
    contract_to_size(contractor, mesh, options_);
    simplified_ = simplified_mesh(contractor, mesh, 0);
    scale_ = normalization(seen[0]).scale;

    std::vector<Index> vertex_of(mesh.vertex_count, kNone);
    for (Index i = 0; i < simplified_.vertices.size(); ++i) vertex_of[simplified_.vertices[i]] = i;
    clusters_.resize(mesh.vertex_count);
    vertex_.resize(mesh.vertex_count);
    member_count_.assign(simplified_.vertices.size(), 0);
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      clusters_[v] = contractor.representative(v);
      vertex_[v] = vertex_of[clusters_[v]];
      if (vertex_[v] != kNone) ++member_count_[vertex_[v]];
    }
    vertex_quadrics_.emplace(mesh, options_.contract.quadrics);
    unit_.resize(mesh.vertex_count);
    quadrics_.resize(mesh.vertex_count);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    const Normalization normalize{normalization(positions).center, scale_};
    for (Index v = 0; v < mesh_->vertex_count; ++v) unit_[v] = normalize.to_unit(positions[v]);
    vertex_quadrics_->compute(unit_, quadrics_);
    sums_.assign(simplified_.vertices.size(), Quadric{});
    for (Index v = 0; v < mesh_->vertex_count; ++v) {
      if (vertex_[v] != kNone) sums_[vertex_[v]] += quadrics_[v];
    }
    out.positions.resize(sums_.size());
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      // As the contraction has it: what nothing was contracted into stays where it is.
      out.positions[i] =
          member_count_[i] == 1 ? positions[simplified_.vertices[i]] : normalize.from_unit(minimum(sums_[i]).point);
    }
    out.adapt_seconds = adapting.seconds();

    const ThreadTimer extracting;
    out.triangles = simplified_.mesh.triangles;
    out.nodes = simplified_.vertices;
    out.extract_seconds = extracting.seconds();
    out.clusters = clusters_;
  }

 private:
  MethodOptions options_;
  const Mesh* mesh_ = nullptr;
  Simplified simplified_;
  double scale_ = 1;                 // of the first frame's normalization, used for all
  std::vector<Index> clusters_;      // [vertex_count]: the representative
  std::vector<Index> vertex_;        // [vertex_count]: of the approximation; kNone where its cluster is not drawn
  std::vector<Index> member_count_;  // [simplified_.vertices.size()]
  std::optional<VertexQuadrics> vertex_quadrics_;
  std::vector<Vec3d> unit_;  // [vertex_count], scratch, as the next two
  std::vector<Quadric> quadrics_;
  std::vector<Quadric> sums_;
};

}  // namespace

std::unique_ptr<Method> make_first_frame(const MethodOptions& options) { return std::make_unique<FirstFrame>(options); }

}  // namespace limber::eval
