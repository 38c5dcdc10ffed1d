// SPDX-License-Identifier: Apache-2.0
// Mohr & Gleicher 2003, "Deformation sensitive decimation" (DSD): one sequence of contractions for all frames at once.
//
//   begin:  contract under the cost of an edge summed over the frames seen, each frame with a minimum of its own
//   frame:  place the clusters anew (static_clusters.h)
//
// The paper's poses are the frames seen: all of the clip where memory allows, otherwise as many as it holds, spread
// evenly (many_frames()). Frames in between are placed by their own quadrics all the same.
#include <optional>

#include "eval/methods/contract_to_size.h"
#include "eval/methods/factories.h"
#include "eval/methods/static_clusters.h"

namespace limber::eval {
namespace {

class Dsd final : public Method {
 public:
  explicit Dsd(const MethodOptions& options) : options_(options) {}

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

std::unique_ptr<Method> make_dsd(const MethodOptions& options) { return std::make_unique<Dsd>(options); }

}  // namespace limber::eval
