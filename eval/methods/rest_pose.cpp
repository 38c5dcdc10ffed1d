// SPDX-License-Identifier: Apache-2.0
// What real-time engines do: the first frame is simplified once, to vertices that it has already, and these are then
// animated like all others (Garland & Heckbert 1997, section 4: "subset placement"; Mohr & Gleicher 2003, section 1).
//
//   begin:  contract the first frame
//           of every cluster, keep the vertex where the cluster's quadric is smallest
//   frame:  the positions of these vertices
//
// The clusters are those of `first-frame`: the contraction is not told that its vertices will end at input vertices, as
// half-edge collapses would be, and in return may choose among all vertices of a cluster and not only two.
#include <limits>
#include <optional>

#include "eval/methods/contract_to_size.h"
#include "eval/methods/factories.h"
#include "eval/methods/static_clusters.h"
#include "eval/methods/thread_time.h"

namespace limber::eval {
namespace {

// [clusters.size()]: the vertex of each cluster where its quadric is smallest.
std::vector<Index> best_members(StaticClusters& clusters, std::span<const Vec3f> positions) {
  Normalization normalize;
  const std::span<const Quadric> sums = clusters.sum_quadrics(positions, normalize);
  std::vector<Index> best(clusters.size(), kNone);
  std::vector<double> least(clusters.size(), std::numeric_limits<double>::infinity());
  for (Index v = 0; v < positions.size(); ++v) {
    const Index cluster = clusters.cluster_of()[v];
    if (cluster == kNone) continue;
    const double error = sums[cluster](normalize.to_unit(positions[v]));
    if (error < least[cluster]) least[cluster] = error, best[cluster] = v;
  }
  return best;
}

class RestPose final : public Method {
 public:
  explicit RestPose(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    Contractor contractor(mesh, seen.first(1), options_.contract);
    contract_to_size(contractor, mesh, options_);
    clusters_.emplace(mesh, contractor, seen[0], options_.contract.quadrics);
    vertices_ = best_members(*clusters_, seen[0]);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    out.positions.resize(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) out.positions[i] = positions[vertices_[i]];
    out.adapt_seconds = adapting.seconds();
    clusters_->connect(out);
    out.nodes = vertices_;
  }

 private:
  MethodOptions options_;
  std::optional<StaticClusters> clusters_;
  std::vector<Index> vertices_;  // [clusters_->size()]
};

}  // namespace

std::unique_ptr<Method> make_rest_pose(const MethodOptions& options) { return std::make_unique<RestPose>(options); }

}  // namespace limber::eval
