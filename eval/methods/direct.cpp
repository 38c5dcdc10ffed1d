// SPDX-License-Identifier: Apache-2.0
// Garland & Heckbert 1997, each frame by itself: what every method that follows a clip is compared with. With volume
// placement Lindstrom & Turk 1998.
#include "eval/methods/contract_to_size.h"
#include "eval/methods/factories.h"
#include "eval/methods/thread_time.h"

namespace limber::eval {
namespace {

class Direct final : public Method {
 public:
  explicit Direct(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>>) override { mesh_ = &mesh; }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    const auto contraction = start_contraction(*mesh_, positions, options_.contract);
    contract_to_size(*contraction, *mesh_, options_);
    out.adapt_seconds = adapting.seconds();

    const ThreadTimer extracting;
    Simplified simplified = simplified_mesh(*contraction, *mesh_, 0);
    out.triangles = std::move(simplified.mesh.triangles);
    out.positions = std::move(simplified.positions);
    out.nodes = std::move(simplified.vertices);
    out.extract_seconds = extracting.seconds();

    out.clusters.resize(mesh_->vertex_count);
    for (Index v = 0; v < mesh_->vertex_count; ++v) out.clusters[v] = contraction->representative(v);
  }

 private:
  MethodOptions options_;
  const Mesh* mesh_ = nullptr;
};

}  // namespace

std::unique_ptr<Method> make_direct(const MethodOptions& options) { return std::make_unique<Direct>(options); }

std::unique_ptr<Method> make_direct_volume(const MethodOptions& options) {
  MethodOptions by_volume = options;
  by_volume.contract.placement = Placement::kVolume;
  return std::make_unique<Direct>(by_volume);
}

}  // namespace limber::eval
