// SPDX-License-Identifier: Apache-2.0
// The clusters of the first frame for the whole clip: what Mohr & Gleicher 2003 call the naive approach, with the
// optimal position of every cluster in every frame.
//
//   begin:  contract the first frame; its clusters and triangles stay
//   frame:  place the clusters anew (static_clusters.h)
#include <optional>

#include "eval/methods/contract_to_size.h"
#include "eval/methods/factories.h"
#include "eval/methods/static_clusters.h"

namespace limber::eval {
namespace {

class FirstFrame final : public Method {
 public:
  explicit FirstFrame(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    Contractor contractor(mesh, seen.first(1), options_.contract);
    contract_to_size(contractor, mesh, options_);
    clusters_.emplace(mesh, contractor, seen[0], options_.contract.quadrics);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override { clusters_->frame(positions, out); }

 private:
  MethodOptions options_;
  std::optional<StaticClusters> clusters_;
};

}  // namespace

std::unique_ptr<Method> make_first_frame(const MethodOptions& options) { return std::make_unique<FirstFrame>(options); }

}  // namespace limber::eval
