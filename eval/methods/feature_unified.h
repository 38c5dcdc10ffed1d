// SPDX-License-Identifier: Apache-2.0
// Zhang & Wu 2007, sections 3.1 to 3.3: the contractions that all frames of a clip have in common.
#pragma once

#include <span>
#include <vector>

#include "eval/methods/feature_quadrics.h"
#include "eval/methods/method.h"

namespace limber::eval {

struct UnifiedMesh {
  Mesh mesh;                        // the vertices are those that a triangle uses
  std::vector<Index> vertices;      // [mesh.vertex_count]: the vertex of the input that stands for it, ascending
  std::vector<Index> member_count;  // [mesh.vertex_count]: vertices of the input that it stands for
  std::vector<Index> clusters;      // [vertex_count of the input]: the vertex of the input that stands for it
  std::vector<Index> nodes;         // [vertex_count of the input]: the vertex of `mesh`; kNone where none is left
};

// Contracts to the size in `options` under the cost of section 3.2, and keeps of the contractions the first, a share of
// options.feature.unified_share, rounded down. seen: at least one frame, each [mesh.vertex_count]; the first and the
// last say what the features are. quadrics: of the same mesh and options.
UnifiedMesh contract_unified(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen, FeatureQuadrics& quadrics,
                             const MethodOptions& options);

}  // namespace limber::eval
