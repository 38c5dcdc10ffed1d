// SPDX-License-Identifier: Apache-2.0
// The time-dependent directed acyclic graph of Shamir, Bajaj & Pascucci 2000, "Multi-resolution dynamic meshes with
// arbitrary deformations", and Shamir & Pascucci 2001, as the two papers that limber follows describe it: the
// hierarchies of all frames merged into one graph, in which each node carries the interval of frames over which it
// lives; built frame by frame, the decimation of a frame takes the one before into account. What follows is our
// reading of that.
//
//   begin:  the graph has the vertices of the mesh, each by itself
//   frame:  contract the frame to the size asked for (QSlim), where a contraction costs `history` of its price whose
//           outcome is a node that lived in the frame before
//           a node is the set of vertices below it (t_dag_forest.h): one that the frame before had lives on, the
//           others of that frame end, those that are new begin (t_dag_code.h)
//           the cut at the size asked for is the roots of what lives
//
// As the mesh keeps its connectivity, the sets of a hierarchy say which node is whose child. Only the living part of
// the graph is kept, so that memory does not grow with the clip: a node that comes back is a new one. Positions are
// placed anew in every frame, as by all methods here; the paper has nodes share them while they change little.
#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "eval/methods/factories.h"
#include "eval/methods/feature_contraction.h"
#include "eval/methods/merged_mesh.h"
#include "eval/methods/t_dag_code.h"
#include "eval/methods/t_dag_forest.h"
#include "eval/methods/thread_time.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber::eval {
namespace {

// Makes contractions cheaper that lead to a living node.
class History final : public EdgeFactor {
 public:
  History(const Forest& living, double factor) : living_(living), factor_(factor) {
    for (Index v = 0; v < living.vertex_count(); ++v) sets_.push_back(living.footprint(v));
  }

  double factor(Surface& surface, std::span<const Vec3f>, Index edge) override {
    const auto [u, v] = surface.ends(edge);
    return living_.is_node(Forest::join(sets_[u], sets_[v])) ? factor_ : 1;
  }

  bool is_of_ends() const override { return true; }

  void contracted(Index stays, Index goes) override { sets_[stays] = Forest::join(sets_[stays], sets_[goes]); }

 private:
  const Forest& living_;
  double factor_;
  std::vector<Forest::Footprint> sets_;  // [vertex_count]: what a vertex has taken in
};

class TDag final : public Method {
 public:
  explicit TDag(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>>) override {
    mesh_ = &mesh;
    surface_.emplace(mesh);
    vertex_quadrics_.emplace(mesh, options_.contract.quadrics);
    graph_.emplace(mesh);
    names_.resize(mesh.vertex_count);
    std::iota(names_.begin(), names_.end(), Index{0});
    unit_.resize(mesh.vertex_count);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    const Normalization normalize = normalization(positions);
    History history(graph_->living(), options_.history);
    FeatureContraction contraction(*surface_, frame_data(positions, normalize), options_.contract, 0, history);
    contraction.contract_to(options_.vertices, options_.triangles);
    take_roots(contraction.merges());
    out.adapt_seconds = adapting.seconds();

    const ThreadTimer extracting;
    list_merged(*mesh_, roots_, contraction, normalize, drawn_, out);
    for (Index& node : out.nodes) node = name_of_[node];
    out.extract_seconds = extracting.seconds();

    out.clusters = names_;
    out.choice_bytes = graph_->encode(Forest(mesh_->vertex_count, contraction.merges())).size();
  }

 private:
  FrameData frame_data(std::span<const Vec3f> positions, const Normalization& normalize) {
    FrameData data{1, std::vector<Quadric>(mesh_->vertex_count), std::vector<Vec3f>(mesh_->vertex_count)};
    for (Index v = 0; v < mesh_->vertex_count; ++v) {
      unit_[v] = normalize.to_unit(positions[v]);
      data.positions[v] = static_cast<Vec3f>(unit_[v]);
    }
    vertex_quadrics_->compute(unit_, data.quadrics);
    return data;
  }

  // A root is called after the one of the frame before of which it has the most vertices, among those whose name is a
  // vertex of it: so it keeps its name while it lives, and when small parts come and go.
  void take_roots(std::span<const FeatureContraction::Merge> merges) {
    const Index vertex_count = mesh_->vertex_count;
    find_roots(vertex_count, merges, roots_);
    votes_.assign(vertex_count, 0);
    for (Index v = 0; v < vertex_count; ++v)
      if (roots_[v] == roots_[names_[v]]) ++votes_[names_[v]];
    name_of_.assign(vertex_count, kNone);
    for (Index v = 0; v < vertex_count; ++v) {
      Index& name = name_of_[roots_[v]];
      if (name == kNone || votes_[v] > votes_[name]) name = v;
    }
    for (Index v = 0; v < vertex_count; ++v) names_[v] = name_of_[roots_[v]];
  }

  MethodOptions options_;
  const Mesh* mesh_ = nullptr;
  std::optional<Surface> surface_;
  std::optional<VertexQuadrics> vertex_quadrics_;
  std::optional<TDagCode> graph_;
  std::vector<Index> names_;    // [vertex_count]: of each one's root in the latest frame; a vertex of that root
  std::vector<Index> roots_;    // [vertex_count]: by what stands for them in the contraction
  std::vector<Index> name_of_;  // [vertex_count]: by roots_
  std::vector<Index> votes_;    // [vertex_count], scratch, as all that follow
  std::vector<Index> drawn_;
  std::vector<Vec3d> unit_;
};

}  // namespace

std::unique_ptr<Method> make_t_dag(const MethodOptions& options) { return std::make_unique<TDag>(options); }

}  // namespace limber::eval
