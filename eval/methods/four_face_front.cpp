// SPDX-License-Identifier: Apache-2.0
// Velho 2001 on a clip: one 4-K mesh for all frames, and in each a front of it by the frame's own errors, which follows
// that of the frame before. All vertices are those of the input.
//
//   begin:  build a 4-K mesh, its costs summed over the frames
//   frame:  the errors of its operations in this pose; move the front to them, with hysteresis
#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "eval/methods/factories.h"
#include "eval/methods/thread_time.h"
#include "limber/base/triangles.h"
#include "limber/fourface/build_four_k.h"
#include "limber/fourface/frame_errors.h"
#include "limber/fourface/front_request.h"

namespace limber::eval {
namespace {

class FourFaceFront final : public Method {
 public:
  explicit FourFaceFront(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    mesh_ = build_four_k(mesh, seen, {.may_fold = true});
    front_.emplace(mesh_);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    measure_frame(mesh_, positions);
    FrontRequest request;
    (options_.vertices > 0 ? request.vertices : request.triangles) = std::max(options_.vertices, options_.triangles);
    move_front(*front_, mesh_, positions, request, {}, is_first_ ? 1 : kHysteresis);
    is_first_ = false;
    out.adapt_seconds = adapting.seconds();
    const ThreadTimer extracting;
    front_->list(out.triangles);
    renumber(out.triangles, mesh_.vertex_count, out.nodes, place_);
    out.positions.resize(out.nodes.size());
    for (std::size_t i = 0; i < out.nodes.size(); ++i) out.positions[i] = positions[out.nodes[i]];
    out.extract_seconds = extracting.seconds();
    find_clusters(out.clusters);
  }

 private:
  // Operations that are applied count so many times less.
  static constexpr double kHysteresis = 2;

  // A vertex that is removed belongs to whom the one that is kept belongs to.
  void find_clusters(std::vector<Index>& clusters) {
    clusters.resize(mesh_.vertex_count);
    std::iota(clusters.begin(), clusters.end(), Index{0});
    for (Index o = mesh_.operation_count(); o-- > 0;)
      if (front_->is_applied(o) && mesh_.is_removal(o)) clusters[mesh_.vertex[o]] = clusters[mesh_.kept(o)];
  }

  MethodOptions options_;
  FourKMesh mesh_;
  std::optional<Front> front_;
  std::vector<Index> place_;
  bool is_first_ = true;
};

}  // namespace

std::unique_ptr<Method> make_four_face_front(const MethodOptions& options) {
  return std::make_unique<FourFaceFront>(options);
}

}  // namespace limber::eval
