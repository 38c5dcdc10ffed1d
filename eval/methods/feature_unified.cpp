// SPDX-License-Identifier: Apache-2.0
// Zhang & Wu 2007, sections 3.1 to 3.3.
//
//   cost of an edge = (1 + k2 x (feature weight in the first frame + in the last)) x sum over the frames of c(t)
//                   + k1 x sum over the frames of |c(t) - mean of c|
//   contract, cheapest first, to the size asked for: N contractions
//   what all frames have in common is the mesh after the first P x N of them
#include "eval/methods/feature_unified.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "eval/methods/feature_contraction.h"
#include "eval/methods/feature_weight.h"
#include "eval/methods/merged_mesh.h"
#include "limber/base/portable_math.h"
#include "limber/base/triangles.h"

namespace limber::eval {
namespace {

class FeatureFactor final : public EdgeFactor {
 public:
  FeatureFactor(const FeatureOptions& options, std::size_t frame_count)
      : options_(options), frame_count_(frame_count), sharp_cosine_(portable_cos(options.sharp_angle * (kPi / 180))) {}

  double factor(Surface& surface, std::span<const Vec3f> positions, Index edge) override {
    if (options_.feature == 0) return 1;
    double weight = 0;
    for (const std::size_t frame : {std::size_t{0}, frame_count_ - 1})
      weight += feature_weight(surface, edge, {positions, frame_count_, frame}, sharp_cosine_, options_.literal);
    // As printed the weight can be less than -1.
    return std::max(0.0, 1 + options_.feature * weight);
  }

 private:
  FeatureOptions options_;
  std::size_t frame_count_;
  double sharp_cosine_;
};

FrameData frame_data(Index vertex_count, std::span<const std::span<const Vec3f>> seen, FeatureQuadrics& quadrics) {
  const std::size_t frame_count = seen.size();
  FrameData data{frame_count, std::vector<Quadric>(vertex_count * frame_count),
                 std::vector<Vec3f>(vertex_count * frame_count)};
  const double scale = normalization(seen[0]).scale;
  std::vector<Vec3d> unit(vertex_count);
  std::vector<Quadric> of_one_frame(vertex_count);
  for (std::size_t f = 0; f < frame_count; ++f) {
    const Normalization normalize{normalization(seen[f]).center, scale};
    for (Index v = 0; v < vertex_count; ++v) unit[v] = normalize.to_unit(seen[f][v]);
    quadrics.compute(unit, of_one_frame);
    for (Index v = 0; v < vertex_count; ++v) {
      data.quadrics[v * frame_count + f] = of_one_frame[v];
      data.positions[v * frame_count + f] = static_cast<Vec3f>(unit[v]);
    }
  }
  return data;
}

// The mesh after some contractions, in their order.
UnifiedMesh contracted_mesh(const Mesh& mesh, std::span<const FeatureContraction::Merge> merges) {
  UnifiedMesh out;
  find_roots(mesh.vertex_count, merges, out.clusters);
  out.nodes.assign(mesh.vertex_count, kNone);
  list_images(mesh.triangles, out.clusters, out.mesh.triangles);
  for (const Triangle& image : out.mesh.triangles) {
    for (const Index corner : image) out.nodes[corner] = 0;
  }
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    if (out.nodes[v] == kNone) continue;
    out.nodes[v] = static_cast<Index>(out.vertices.size());
    out.vertices.push_back(v);
  }
  for (Triangle& t : out.mesh.triangles) {
    for (Index& corner : t) corner = out.nodes[corner];
  }
  out.mesh.vertex_count = static_cast<Index>(out.vertices.size());
  out.member_count.assign(out.mesh.vertex_count, 0);
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    out.nodes[v] = out.nodes[out.clusters[v]];
    if (out.nodes[v] != kNone) ++out.member_count[out.nodes[v]];
  }
  return out;
}

}  // namespace

UnifiedMesh contract_unified(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen, FeatureQuadrics& quadrics,
                             const MethodOptions& options) {
  FeatureFactor factor(options.feature, seen.size());
  FeatureContraction contraction(Surface(mesh), frame_data(mesh.vertex_count, seen, quadrics), options.contract,
                                 options.feature.deformation, factor);
  contraction.contract_to(options.vertices, options.triangles);
  const auto all = contraction.merges();
  const auto unified =
      static_cast<std::size_t>(std::floor(options.feature.unified_share * static_cast<double>(all.size())));
  return contracted_mesh(mesh, all.first(std::min(unified, all.size())));
}

}  // namespace limber::eval
