// SPDX-License-Identifier: Apache-2.0
// The multilevel mesh of the first frame (Kircher & Garland 2005, section 3).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/contract/contract.h"
#include "limber/hierarchy/hierarchy.h"

namespace limber {

struct BuildOptions {
  // Each level has about 1/branching of the vertices of the one below, > 1. The closer to 1, the better the cuts whose
  // size lies between two levels, and the larger the stream (docs/design.md, "How many levels"); the paper used 8.
  double branching = 2;
  // Exact vertex counts of some levels above the finest, strictly decreasing, >= 1. Between the finest level and these,
  // and between two of them, there are more levels, evenly in their ratio, where it exceeds branching^1.5; beyond the
  // last they go on by `branching`.
  std::vector<Index> level_sizes;
  ContractOptions contract;
};

// No level is made with fewer vertices than this by `branching`; level_sizes may go lower.
inline constexpr Index kSmallestLevel = 12;

// Contracts the mesh level by level under the quadrics of all the given frames together; at least one, each
// [mesh.vertex_count], finite. Isolated vertices have a node of their own on every level, beyond the size asked for.
// A level that the topology does not allow to be as small as asked is as small as it can be; levels that would equal
// the one below are left out. Nodes of a level are numbered by their first vertex.
Hierarchy build_hierarchy(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames,
                          const BuildOptions& options);

// The same, but asks go_on often enough for a person who waits. Error: kCancelled when it gives false.
Result<Hierarchy> build_hierarchy(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames,
                                  const BuildOptions& options, const GoOnFunction& go_on);

// Of one frame, with levels of the same sizes as those of `model`, which is over the same mesh; none where the mesh
// cannot be contracted to just these. positions: [mesh.vertex_count], finite.
std::optional<Hierarchy> build_alike(const Mesh& mesh, std::span<const Vec3f> positions, const Hierarchy& model,
                                     const ContractOptions& options);

// The vertex counts that build_hierarchy aims at above the finest level, decreasing, for a mesh of this many vertices.
// Sizes asked for that are not smaller than the mesh are left out.
std::vector<Index> level_targets(Index vertex_count, const BuildOptions& options);

}  // namespace limber
