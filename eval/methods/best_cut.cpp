// SPDX-License-Identifier: Apache-2.0
// A static hierarchy, and in every frame the cut through it that is best for that frame: what view-dependent refinement
// of a vertex hierarchy (Hoppe 1997; Luebke & Erikson 1997) gives a deforming mesh. Kircher & Garland 2005, section 1,
// argue against it.
//
//   begin:  build the hierarchy under the sum of the frames seen, in as fine levels as a vertex hierarchy comes near to
//   frame:  quadrics of the vertices, summed up the hierarchy; positions and errors at their minima
//           the cut of the size asked for that has the least error (limber/view/budget.h)
#include <algorithm>
#include <cmath>
#include <optional>

#include "eval/methods/cut_mesh.h"
#include "eval/methods/factories.h"
#include "eval/methods/many_frames.h"
#include "eval/methods/thread_time.h"
#include "limber/contract/vertex_quadrics.h"
#include "limber/hierarchy/build.h"

namespace limber::eval {
namespace {

// A cut can only be as good as the steps of the hierarchy are small.
constexpr double kBranching = 1.25;

class BestCut final : public Method {
 public:
  explicit BestCut(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    mesh_ = &mesh;
    state_.hierarchy =
        build_hierarchy(mesh, seen, {.branching = kBranching, .contract = for_many_frames(options_.contract)});
    const Index node_count = state_.hierarchy.node_count();
    state_.positions.resize(node_count);
    state_.errors.resize(node_count);
    unit_.resize(mesh.vertex_count);
    quadrics_.resize(node_count);
    vertex_quadrics_.emplace(mesh, options_.contract.quadrics);
    cut_mesh_.emplace(mesh, state_.hierarchy, cut_to_size(options_));
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    place(positions);
    out.adapt_seconds = adapting.seconds();
    cut_mesh_->frame(state_, out);
  }

 private:
  // Each frame by its own size, as what the cut compares is of one frame.
  void place(std::span<const Vec3f> positions) {
    const Index vertex_count = mesh_->vertex_count, node_count = state_.hierarchy.node_count();
    const Normalization normalize = normalization(positions);
    for (Index v = 0; v < vertex_count; ++v) unit_[v] = normalize.to_unit(positions[v]);
    vertex_quadrics_->compute(unit_, std::span(quadrics_).first(vertex_count));
    std::fill(quadrics_.begin() + vertex_count, quadrics_.end(), Quadric{});
    for (Index node = 0; node < node_count; ++node) {
      const Index parent = state_.hierarchy.parent[node];
      if (parent != kNone) quadrics_[parent] += quadrics_[node];
    }
    std::copy(positions.begin(), positions.end(), state_.positions.begin());
    const double unit_error = 1 / (normalize.scale * normalize.scale);
    for (Index node = vertex_count; node < node_count; ++node) {
      const QuadricMinimum at = minimum(quadrics_[node]);
      state_.positions[node] = normalize.from_unit(at.point);
      state_.errors[node] = static_cast<float>(std::sqrt(at.value) * unit_error);
    }
  }

  MethodOptions options_;
  const Mesh* mesh_ = nullptr;
  FrameState state_;
  std::optional<VertexQuadrics> vertex_quadrics_;
  std::optional<CutMesh> cut_mesh_;
  std::vector<Vec3d> unit_;        // [vertex_count], scratch
  std::vector<Quadric> quadrics_;  // [node_count], scratch
};

}  // namespace

std::unique_ptr<Method> make_best_cut(const MethodOptions& options) { return std::make_unique<BestCut>(options); }

}  // namespace limber::eval
