// SPDX-License-Identifier: Apache-2.0
// Day 1985. A node is the largest that begins at its first place, or the largest that ends at its last: were larger
// ones at both, the smaller of those two would be cut by the other. So two tables hold all nodes.
#include "eval/methods/t_dag_forest.h"

#include <cassert>
#include <numeric>
#include <utility>

namespace limber::eval {
namespace {

std::vector<Index> parents(Index vertex_count, std::span<const FeatureContraction::Merge> merges) {
  std::vector<Index> parent(vertex_count + merges.size(), kNone), node_of(vertex_count);
  std::iota(node_of.begin(), node_of.end(), Index{0});
  Index node = vertex_count;
  for (const auto& [stays, goes] : merges) {
    parent[node_of[stays]] = parent[node_of[goes]] = node;
    node_of[stays] = node++;
  }
  return parent;
}

}  // namespace

Forest::Forest(Index vertex_count) : Forest(vertex_count, std::vector<Index>(vertex_count, kNone)) {}

Forest::Forest(Index vertex_count, std::span<const FeatureContraction::Merge> merges)
    : Forest(vertex_count, parents(vertex_count, merges)) {}

Forest::Forest(Index vertex_count, std::vector<Index> parent)
    : parent_(std::move(parent)), place_(vertex_count), largest_from_(vertex_count), largest_to_(vertex_count) {
  assert(parent_.size() >= vertex_count);
  std::vector<Index> count(parent_.size(), 0);
  std::fill_n(count.begin(), vertex_count, Index{1});
  for (Index node = 0; node < node_count(); ++node) {
    assert(parent_[node] == kNone || (parent_[node] > node && parent_[node] >= vertex_count));
    if (parent_[node] != kNone) count[parent_[node]] += count[node];
  }
  // Parents are placed before their children, and written before them where a table has only one place for both.
  std::vector<Index> next(parent_.size());  // where the next child of a node begins
  Index next_root = 0;
  std::ranges::fill(largest_from_, kNone);
  std::ranges::fill(largest_to_, kNone);
  for (Index node = node_count(); node-- > 0;) {
    Index& free = parent_[node] == kNone ? next_root : next[parent_[node]];
    const Index first = std::exchange(free, free + count[node]), last = first + count[node] - 1;
    next[node] = first;
    if (largest_from_[first] == kNone) largest_from_[first] = last;
    if (largest_to_[last] == kNone) largest_to_[last] = first;
    if (node < vertex_count) place_[node] = first;
  }
}

}  // namespace limber::eval
