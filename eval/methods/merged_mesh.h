// SPDX-License-Identifier: Apache-2.0
// The mesh that a FeatureContraction has come to.
#pragma once

#include <span>
#include <vector>

#include "eval/methods/feature_contraction.h"
#include "eval/methods/method.h"
#include "limber/base/mesh.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber::eval {

// roots: [vertex_count], overwritten: the vertex that stands for each one after `merges`, in their order.
void find_roots(Index vertex_count, std::span<const FeatureContraction::Merge> merges, std::vector<Index>& roots);

// The triangles and positions of the approximation, of the contraction's first frame; its nodes are roots. roots:
// find_roots(); place: scratch.
void list_merged(const Mesh& mesh, std::span<const Index> roots, const FeatureContraction& contraction,
                 const Normalization& normalize, std::vector<Index>& place, Approximation& out);

}  // namespace limber::eval
