// SPDX-License-Identifier: Apache-2.0
// Zhang & Wu 2007, "Deforming Surface Simplification Based on Feature Preservation", section 3. The formulas that are
// not as printed, and why: docs/design.md, "Zhang and Wu".
//
//   begin:  contract_unified(): the contractions that all frames have in common (feature_unified.cpp)
//   frame:  quadrics of the vertices, summed over what is left; contract that under the quadrics of this frame alone
//
// Memory, which is ours: in a frame a contraction costs kRemembered of its price where both ends lay in one cluster in
// the frame before. What was chosen there stays until something else is that much better, and triangles stop
// flickering.
#include <memory>
#include <optional>
#include <utility>

#include "eval/methods/factories.h"
#include "eval/methods/feature_contraction.h"
#include "eval/methods/feature_quadrics.h"
#include "eval/methods/feature_suffix.h"
#include "eval/methods/feature_unified.h"
#include "eval/methods/merged_mesh.h"
#include "eval/methods/thread_time.h"

namespace limber::eval {
namespace {

// Less is calmer and coarser: horse-gallop at 800 vertices has .5 % more RMS for a third less change at 0.8, and 2 %
// more for two thirds less at 0.5.
constexpr double kRemembered = 0.75;

// The clusters of the frame before, of which those of this frame are made as far as they fit.
class ClusterMemory final : public EdgeFactor {
 public:
  double factor(Surface& surface, std::span<const Vec3f>, Index edge) override {
    const auto [u, v] = surface.ends(edge);
    return before_[u] == before_[v] && before_[u] != kNone ? kRemembered : 1;
  }

  bool is_of_ends() const override { return true; }

  void contracted(Index stays, Index goes) override {
    if (before_[stays] != before_[goes]) before_[stays] = kNone;
  }

  // clusters: [vertex_count]; kNone remembers nothing.
  void remember(std::span<const Index> clusters) { before_.assign(clusters.begin(), clusters.end()); }

 private:
  std::vector<Index> before_;  // [vertex_count]: of what a vertex has taken in; kNone for more than one
};

class Feature final : public Method {
 public:
  explicit Feature(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    mesh_ = &mesh;
    scale_ = normalization(seen[0]).scale;
    quadrics_.emplace(mesh, seen.front(), seen.back(), options_);
    unified_ = contract_unified(mesh, seen, *quadrics_, options_);
    surface_.emplace(unified_.mesh);
    suffix_code_.emplace(unified_.mesh);
    unit_.resize(mesh.vertex_count);
    vertex_quadrics_.resize(mesh.vertex_count);
    clusters_.assign(unified_.mesh.vertex_count, kNone);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    const Normalization normalize{normalization(positions).center, scale_};
    memory_.remember(clusters_);
    FeatureContraction contraction(*surface_, frame_data(positions, normalize), options_.contract, 0, memory_);
    contraction.contract_to(options_.vertices, options_.triangles);
    take_clusters(contraction.merges());
    out.adapt_seconds = adapting.seconds();

    const ThreadTimer extracting;
    list_merged(unified_.mesh, roots_, contraction, normalize, drawn_, out);
    for (Index& node : out.nodes) node = unified_.vertices[names_[node]];
    out.extract_seconds = extracting.seconds();

    out.clusters = unified_.clusters;
    for (Index v = 0; v < mesh_->vertex_count; ++v) {
      if (unified_.nodes[v] != kNone) out.clusters[v] = unified_.vertices[names_[roots_[unified_.nodes[v]]]];
    }
    out.choice_bytes = suffix_code_->encode(roots_).size();
    if (options_.feature.memory) clusters_ = roots_;
  }

 private:
  // The unified mesh in one frame.
  FrameData frame_data(std::span<const Vec3f> positions, const Normalization& normalize) {
    for (Index v = 0; v < mesh_->vertex_count; ++v) unit_[v] = normalize.to_unit(positions[v]);
    quadrics_->compute(unit_, vertex_quadrics_);
    const Index node_count = unified_.mesh.vertex_count;
    FrameData data{1, std::vector<Quadric>(node_count), std::vector<Vec3f>(node_count)};
    for (Index v = 0; v < mesh_->vertex_count; ++v) {
      if (unified_.nodes[v] != kNone) data.quadrics[unified_.nodes[v]] += vertex_quadrics_[v];
    }
    for (Index node = 0; node < node_count; ++node) {
      data.positions[node] = static_cast<Vec3f>(unified_.member_count[node] == 1 ? unit_[unified_.vertices[node]]
                                                                                 : minimum(data.quadrics[node]).point);
    }
    return data;
  }

  void take_clusters(std::span<const FeatureContraction::Merge> merges) {
    const Index node_count = unified_.mesh.vertex_count;
    find_roots(node_count, merges, roots_);
    // A cluster is called after the largest of its parts, so that it keeps the name when small ones come and go.
    names_ = roots_;
    for (Index node = 0; node < node_count; ++node) {
      Index& name = names_[roots_[node]];
      const Index size = unified_.member_count[node], largest = unified_.member_count[name];
      if (size > largest || (size == largest && node < name)) name = node;
    }
  }

  MethodOptions options_;
  const Mesh* mesh_ = nullptr;
  double scale_ = 1;  // of the first frame's normalization, used for all
  std::optional<FeatureQuadrics> quadrics_;
  UnifiedMesh unified_;
  std::optional<Surface> surface_;  // of unified_.mesh
  std::optional<SuffixCode> suffix_code_;
  ClusterMemory memory_;
  std::vector<Index> clusters_;  // [unified_.mesh.vertex_count]: what is remembered
  std::vector<Index> roots_;     // [unified_.mesh.vertex_count]: this frame's clusters, by what stands for them
  std::vector<Index> names_;     // [unified_.mesh.vertex_count]: by roots_
  std::vector<Vec3d> unit_;      // [mesh_->vertex_count], scratch, as all that follow
  std::vector<Quadric> vertex_quadrics_;
  std::vector<Index> drawn_;
};

}  // namespace

std::unique_ptr<Method> make_feature(const MethodOptions& options) { return std::make_unique<Feature>(options); }

}  // namespace limber::eval
