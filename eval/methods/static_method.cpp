// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/static_method.h"

#include <optional>
#include <utility>

#include "eval/methods/contract_to_size.h"
#include "eval/methods/static_clusters.h"

namespace limber::eval {
namespace {

class StaticMethod final : public Method {
 public:
  StaticMethod(const MethodOptions& options, MakeContractor make_contractor)
      : options_(options), make_contractor_(std::move(make_contractor)) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    Contractor contractor = make_contractor_(mesh, seen, options_.contract);
    contract_to_size(contractor, mesh, options_);
    clusters_.emplace(mesh, contractor, seen[0], options_.contract.quadrics);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override { clusters_->frame(positions, out); }

 private:
  MethodOptions options_;
  MakeContractor make_contractor_;
  std::optional<StaticClusters> clusters_;
};

}  // namespace

std::unique_ptr<Method> make_static_method(const MethodOptions& options, MakeContractor make_contractor) {
  return std::make_unique<StaticMethod>(options, std::move(make_contractor));
}

}  // namespace limber::eval
