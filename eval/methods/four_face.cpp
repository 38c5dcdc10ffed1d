// SPDX-License-Identifier: Apache-2.0
// Velho 2001: the first frame simplified by four-face clusters, level by level, to vertices that it has already; these
// are then animated like all others.
//
//   begin:  build a 4-K mesh, until it is as small as asked for
//   frame:  the positions of the vertices that are left
#include <numeric>
#include <vector>

#include "eval/methods/factories.h"
#include "eval/methods/thread_time.h"
#include "limber/base/triangles.h"
#include "limber/fourface/build_four_k.h"

namespace limber::eval {
namespace {

class FourFace final : public Method {
 public:
  explicit FourFace(const MethodOptions& options) : options_(options) {}

  void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) override {
    const FourKMesh made =
        build_four_k(mesh, seen[0], {.vertices = options_.vertices, .triangles = options_.triangles, .may_fold = true});
    triangles_ = triangles_after(made, made.operation_count());
    std::vector<Index> place;
    renumber(triangles_, mesh.vertex_count, vertices_, place);
    find_clusters(made);
  }

  void frame(std::span<const Vec3f> positions, Approximation& out) override {
    const ThreadTimer adapting;
    out.positions.resize(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) out.positions[i] = positions[vertices_[i]];
    out.adapt_seconds = adapting.seconds();
    const ThreadTimer extracting;
    out.triangles = triangles_;
    out.nodes = vertices_;
    out.clusters = clusters_;
    out.extract_seconds = extracting.seconds();
  }

 private:
  // A vertex that was removed belongs to whom the one that was kept belongs to.
  void find_clusters(const FourKMesh& made) {
    clusters_.resize(made.vertex_count);
    std::iota(clusters_.begin(), clusters_.end(), Index{0});
    for (Index o = made.operation_count(); o-- > 0;)
      if (made.is_removal(o)) clusters_[made.vertex[o]] = clusters_[made.kept(o)];
  }

  MethodOptions options_;
  std::vector<Triangle> triangles_;
  std::vector<Index> vertices_;  // the input's, of each of the approximation
  std::vector<Index> clusters_;
};

}  // namespace

std::unique_ptr<Method> make_four_face(const MethodOptions& options) { return std::make_unique<FourFace>(options); }

}  // namespace limber::eval
