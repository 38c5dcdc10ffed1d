// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/clustering.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace limber {

Clustering::Clustering(Hierarchy base)
    : hierarchy_(std::move(base)),
      children_(hierarchy_),
      quadrics_(hierarchy_.node_count()),
      facings_(hierarchy_.node_count()),
      minima_(hierarchy_.node_count()),
      energies_(hierarchy_.node_count(), 0.0) {}

void Clustering::replace(const Hierarchy& hierarchy) {
  assert(hierarchy.level_begin == hierarchy_.level_begin);
  hierarchy_.parent = hierarchy.parent;  // in its place: others refer to it
  children_ = ChildLists(hierarchy_);
}

void Clustering::place(Index node) {
  const QuadricMinimum at = minimum(quadrics_[node]);
  minima_[node] = at.point;
  energies_[node] = at.value;
}

void Clustering::weigh() {
  const Index vertex_count = hierarchy_.vertex_count(), node_count = hierarchy_.node_count();
  std::fill(quadrics_.begin() + vertex_count, quadrics_.end(), Quadric{});
  std::fill(facings_.begin() + vertex_count, facings_.end(), Facing{});
  for (Index node = 0; node < node_count; ++node)
    if (const Index parent = hierarchy_.parent[node]; parent != kNone)
      quadrics_[parent] += quadrics_[node], facings_[parent] += facings_[node];
  for (Index node = vertex_count; node < node_count; ++node) place(node);
}

void Clustering::move(Index node, Index to) {
  Index from = hierarchy_.parent[node];
  children_.move(node, from, to);
  hierarchy_.parent[node] = to;
  for (; from != to && from != kNone; from = hierarchy_.parent[from], to = hierarchy_.parent[to]) {
    quadrics_[from] -= quadrics_[node];
    quadrics_[to] += quadrics_[node];
    facings_[from] -= facings_[node];
    facings_[to] += facings_[node];
    if (children_.first_child(from) == kNone) quadrics_[from] = {}, facings_[from] = {};  // not what rounding has left
    place(from);
    place(to);
  }
}

double Clustering::total_energy(Index level) const {
  double sum = 0;
  for (Index node = hierarchy_.level_begin[level]; node < hierarchy_.level_begin[level + 1]; ++node)
    sum += energies_[node];
  return sum;
}

}  // namespace limber
