// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, section 6: the "average" mesh that they compare with (their Fig. 11).
//
//   begin:  contract under the largest cost of an edge in any of the frames seen
//   frame:  place the clusters anew (static_clusters.h)
//
// The paper looks only at the edges that are the cheapest in some frame, and takes that among them whose largest cost is
// smallest. Here every edge is looked at, so that the largest cost of the one taken is never above the paper's, and one
// queue serves all frames. Frames seen are those of `dsd`.
#include <optional>

#include "eval/methods/contract_to_size.h"
#include "eval/methods/factories.h"
#include "eval/methods/static_clusters.h"

namespace limber::eval {
namespace {

class Average final : public Method {
 public:
  explicit Average(const MethodOptions& options) : options_(options) {
    options_.contract.frame_cost = FrameCost::kLargest;
  }

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    Contractor contractor(mesh, seen, options_.contract);
    contract_to_size(contractor, mesh, options_);
    clusters_.emplace(mesh, contractor, seen[0], options_.contract.quadrics);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override { clusters_->frame(positions, out); }

 private:
  MethodOptions options_;
  std::optional<StaticClusters> clusters_;
};

}  // namespace

std::unique_ptr<Method> make_average(const MethodOptions& options) { return std::make_unique<Average>(options); }

}  // namespace limber::eval
