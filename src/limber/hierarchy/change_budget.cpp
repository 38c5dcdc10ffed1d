// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/change_budget.h"

#include <algorithm>

namespace limber {

void ChangeBudget::limit(std::span<const LevelGraph> graphs, double share) {
  for (Index level = 1; level < graphs.size(); ++level)
    left_[level] = static_cast<Index>(share * static_cast<double>(graphs[level].triangles.size()));
}

// The triangles around the node whose corners are three labels, the node's own among them; equal ones count once.
Index ChangeBudget::count_made(const LevelGraph& graph, Index node, Index label) {
  const auto count = around_.size();
  if (graph.star_of(node) == StarKind::kIrregular) return static_cast<Index>(count);
  sides_.clear();
  for (std::size_t i = graph.star_of(node) == StarKind::kClosed ? 0 : 1; i < count; ++i) {
    const Index a = around_[i == 0 ? count - 1 : i - 1], b = around_[i];
    if (a == b || a == label || b == label) continue;
    const std::array<Index, 2> side{std::min(a, b), std::max(a, b)};
    if (std::find(sides_.begin(), sides_.end(), side) == sides_.end()) sides_.push_back(side);
  }
  return static_cast<Index>(sides_.size());
}

bool ChangeBudget::spend(const LevelGraph& graph, Index node, Index from) {
  if (!is_limited()) return true;
  const std::vector<Index>& parent = hierarchy_.parent;
  around_.assign(graph.around(node).begin(), graph.around(node).end());
  made_.clear();
  Index to = parent[node];
  const Index level = hierarchy_.level_of(to);
  for (; from != to; from = parent[from], to = parent[to]) {
    for (Index& label : around_) label = parent[label];
    made_.push_back(count_made(graph, node, to));
    if (made_.back() > left_[level + made_.size() - 1]) return false;
  }
  for (std::size_t i = 0; i < made_.size(); ++i) left_[level + i] -= made_[i];
  return true;
}

bool ChangeBudget::move(Clustering& clusters, const LevelGraph& graph, Index node, Index to) {
  const Index from = clusters.parent(node);
  clusters.move(node, to);
  if (spend(graph, node, from)) return true;
  clusters.move(node, from);
  return false;
}

}  // namespace limber
