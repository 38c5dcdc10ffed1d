// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/build.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "limber/base/portable_math.h"

namespace limber {
namespace {

// The sizes between two levels, none of them included: as many as make the steps nearest to `branching`.
void add_between(Index finer, Index coarser, double branching, std::vector<Index>& targets) {
  const double ratio = portable_log(static_cast<double>(finer) / coarser), step = portable_log(branching);
  if (!(ratio > 1.5 * step)) return;
  const auto step_count = static_cast<Index>(std::lround(ratio / step));
  Index last = finer;
  for (Index i = 1; i < step_count; ++i) {
    const auto size = static_cast<Index>(std::lround(finer * portable_exp(-ratio * i / step_count)));
    if (size < last && size > coarser) targets.push_back(last = size);
  }
}

// A level for each of the targets, which do not count isolated vertices. Gives what there is so far when cancelled.
Hierarchy contract_levels(const Mesh& mesh, const std::vector<Index>& targets, Contractor& contractor) {
  Hierarchy hierarchy{{0, mesh.vertex_count}, std::vector<Index>(mesh.vertex_count, kNone)};
  const Index isolated_count = mesh.vertex_count - contractor.vertex_count();
  // node_of[v]: the node on the level made last that v belongs to.
  std::vector<Index> node_of(mesh.vertex_count);
  for (Index v = 0; v < mesh.vertex_count; ++v) node_of[v] = v;
  for (const Index target : targets) {
    const Index size = contractor.contract_to(target) + isolated_count;
    if (contractor.is_cancelled()) break;
    if (size == hierarchy.level_size(hierarchy.level_count() - 1)) continue;
    const Index first = hierarchy.node_count();
    hierarchy.level_begin.push_back(first + size);
    hierarchy.parent.resize(first + size, kNone);
    std::vector<Index> node_of_representative(mesh.vertex_count, kNone);
    Index next = first;
    for (Index v = 0; v < mesh.vertex_count; ++v) {
      Index& node = node_of_representative[contractor.representative(v)];
      if (node == kNone) node = next++;
      hierarchy.parent[node_of[v]] = node;
      node_of[v] = node;
    }
    assert(next == hierarchy.node_count());
  }
  return hierarchy;
}

}  // namespace

std::vector<Index> level_targets(Index vertex_count, const BuildOptions& options) {
  assert(options.branching > 1);
  std::vector<Index> targets;
  Index last = vertex_count;
  for (const Index size : options.level_sizes) {
    assert(size >= 1);
    if (size >= last) continue;
    add_between(last, size, options.branching, targets);
    targets.push_back(last = size);
  }
  for (double size = last / options.branching; size >= kSmallestLevel; size /= options.branching) {
    const auto rounded = static_cast<Index>(std::lround(size));
    if (rounded < last) targets.push_back(last = rounded);
  }
  return targets;
}

Hierarchy build_hierarchy(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames,
                          const BuildOptions& options) {
  return std::move(*build_hierarchy(mesh, frames, options, {}));
}

Result<Hierarchy> build_hierarchy(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames,
                                  const BuildOptions& options, const GoOnFunction& go_on) {
  const Error cancelled{ErrorCode::kCancelled, "", "interrupted"};
  Contractor contractor(mesh, frames, options.contract, go_on);
  if (contractor.is_cancelled()) return cancelled;
  Hierarchy hierarchy = contract_levels(mesh, level_targets(contractor.vertex_count(), options), contractor);
  if (contractor.is_cancelled()) return cancelled;
  return hierarchy;
}

std::optional<Hierarchy> build_alike(const Mesh& mesh, std::span<const Vec3f> positions, const Hierarchy& model,
                                     const ContractOptions& options) {
  const std::span<const Vec3f> frames[] = {positions};
  Contractor contractor(mesh, frames, options);
  const Index isolated_count = mesh.vertex_count - contractor.vertex_count();
  std::vector<Index> targets;
  for (Index level = 1; level < model.level_count(); ++level)
    targets.push_back(model.level_size(level) - isolated_count);
  Hierarchy hierarchy = contract_levels(mesh, targets, contractor);
  if (hierarchy.level_begin != model.level_begin) return std::nullopt;
  return hierarchy;
}

}  // namespace limber
