// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, figure 7: a two-level mesh, contracted from the frame itself and then improved by swaps.
#include "eval/methods/contract_to_size.h"
#include "eval/methods/factories.h"
#include "eval/methods/follower.h"
#include "eval/methods/thread_time.h"

namespace limber::eval {
namespace {

struct TwoLevels {
  Hierarchy hierarchy;                 // the clusters of the contraction, numbered by their first vertex
  std::vector<Index> representatives;  // [size of level 1]: the vertex that each cluster was contracted to
};

TwoLevels two_levels(const Contractor& contractor, Index vertex_count) {
  TwoLevels out{{{0, vertex_count}, std::vector<Index>(vertex_count, kNone)}, {}};
  std::vector<Index> node_of(vertex_count, kNone);
  for (Index v = 0; v < vertex_count; ++v) {
    const Index representative = contractor.representative(v);
    Index& node = node_of[representative];
    if (node == kNone) {
      node = vertex_count + static_cast<Index>(out.representatives.size());
      out.representatives.push_back(representative);
    }
    out.hierarchy.parent[v] = node;
  }
  const Index node_count = vertex_count + static_cast<Index>(out.representatives.size());
  out.hierarchy.level_begin.push_back(node_count);
  out.hierarchy.parent.resize(node_count, kNone);
  return out;
}

class Improved final : public Method {
 public:
  explicit Improved(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>>) override { mesh_ = &mesh; }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer contracting;
    const std::span<const Vec3f> frames[] = {positions};
    Contractor contractor(*mesh_, frames, options_.contract);
    contract_to_size(contractor, *mesh_, options_);
    ReclusterOptions recluster = as_contracted(recluster_options(Follow::kPaper), options_.contract);
    recluster.threshold = 0;
    TwoLevels levels = two_levels(contractor, mesh_->vertex_count);
    const double contract_seconds = contracting.seconds();
    Follower follower(*mesh_, std::move(levels.hierarchy), recluster, {.by = CutBy::kLevel, .level = 1});
    follower.frame(positions, out);
    out.adapt_seconds += contract_seconds;

    // The level's nodes are numbered anew in each frame; the vertices of the input are not.
    for (Index& node : out.nodes) node = levels.representatives[node - mesh_->vertex_count];
  }

 private:
  MethodOptions options_;
  const Mesh* mesh_ = nullptr;
};

}  // namespace

std::unique_ptr<Method> make_improved(const MethodOptions& options) { return std::make_unique<Improved>(options); }

}  // namespace limber::eval
