// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/level_graph.h"

#include <algorithm>

#include "limber/base/triangles.h"
#include "limber/contract/edges.h"

namespace limber {

// Puts the neighbours of a node in cyclic order, starting at a border where there is one. sides_ says for each of them
// which two stand beside it.
StarKind LevelGraphBuilder::order_around(Index node, std::span<Index> neighbours) {
  const auto count = static_cast<Index>(neighbours.size());
  if (count < 2) return StarKind::kIrregular;
  sides_.assign(count, {{kNone, kNone}, 0, false});
  for (Index i = incidence_begin_[node]; i < incidence_begin_[node + 1]; ++i) {
    const auto [from, to] = incidences_[i];
    if (to == kNone) continue;
    const Index a = mark_[from], b = mark_[to];
    if (sides_[a].count == 2 || sides_[b].count == 2) return StarKind::kIrregular;
    sides_[a].other[sides_[a].count++] = b;
    sides_[b].other[sides_[b].count++] = a;
    sides_[a].leads = true;
  }
  Index start = 0;
  unsigned open_count = 0;
  for (Index i = count; i-- > 0;) {
    if (sides_[i].count == 0) return StarKind::kIrregular;
    if (sides_[i].count != 1) continue;
    if (open_count == 0 || sides_[i].leads) start = i;
    ++open_count;
  }
  if (open_count != 0 && open_count != 2) return StarKind::kIrregular;
  ordered_.clear();
  Index previous = kNone, at = start;
  do {
    ordered_.push_back(neighbours[at]);
    const Index following = sides_[at].other[0] != previous ? sides_[at].other[0] : sides_[at].other[1];
    previous = at;
    at = following;
  } while (at != start && at != kNone && ordered_.size() <= count);
  if (ordered_.size() != count) return StarKind::kIrregular;  // more than one fan
  if (open_count == 0 && (count < 3 || at != start)) return StarKind::kIrregular;
  std::copy(ordered_.begin(), ordered_.end(), neighbours.begin());
  return open_count == 0 ? StarKind::kClosed : StarKind::kBorder;
}

void LevelGraphBuilder::find_neighbours(Index node_count, LevelGraph& graph) {
  const Index first = graph.first_node;
  incidence_begin_.assign(node_count + 1, 0);
  for (const auto& [a, b, c] : graph.triangles)
    ++incidence_begin_[a - first + 1], ++incidence_begin_[b - first + 1], ++incidence_begin_[c - first + 1];
  for (const auto& [a, b] : graph.edges) ++incidence_begin_[a - first + 1], ++incidence_begin_[b - first + 1];
  for (Index i = 0; i < node_count; ++i) incidence_begin_[i + 1] += incidence_begin_[i];
  incidences_.resize(incidence_begin_.back());
  const auto put = [&](Index node, Index from, Index to) {
    incidences_[incidence_begin_[node - first]++] = {from, to};
  };
  for (const auto& [a, b, c] : graph.triangles) put(a, b, c), put(b, c, a), put(c, a, b);
  for (const auto& [a, b] : graph.edges) put(a, b, kNone), put(b, a, kNone);
  for (Index i = node_count; i > 0; --i) incidence_begin_[i] = incidence_begin_[i - 1];
  incidence_begin_[0] = 0;

  graph.begin.clear();
  graph.neighbours.clear();
  graph.star.clear();
  graph.begin.push_back(0);
  // mark_ is indexed by node id; entries of earlier nodes are told apart by checking what they point to.
  if (mark_.size() < first + node_count) mark_.resize(first + node_count, kNone);
  for (Index i = 0; i < node_count; ++i) {
    const auto begin = static_cast<Index>(graph.neighbours.size());
    const auto add = [&](Index n) {
      const Index at = mark_[n];
      if (at < graph.neighbours.size() - begin && graph.neighbours[begin + at] == n) return;
      mark_[n] = static_cast<Index>(graph.neighbours.size()) - begin;
      graph.neighbours.push_back(n);
    };
    for (Index k = incidence_begin_[i]; k < incidence_begin_[i + 1]; ++k) {
      add(incidences_[k].from);
      if (incidences_[k].to != kNone) add(incidences_[k].to);
    }
    graph.star.push_back(order_around(i, std::span(graph.neighbours).subspan(begin)));
    graph.begin.push_back(static_cast<Index>(graph.neighbours.size()));
  }
}

void LevelGraphBuilder::build_finest(const Mesh& mesh, bool keep_edges, LevelGraph& out) {
  out.first_node = 0;
  out.triangles.clear();
  out.edges.clear();
  std::copy_if(mesh.triangles.begin(), mesh.triangles.end(), std::back_inserter(out.triangles),
               [](const Triangle& t) { return !is_degenerate(t); });
  if (keep_edges) out.edges = find_edges(mesh).ends;
  find_neighbours(mesh.vertex_count, out);
}

void LevelGraphBuilder::build_coarser(const Hierarchy& hierarchy, Index level, const LevelGraph& finer,
                                      LevelGraph& out) {
  const std::vector<Index>& parent = hierarchy.parent;
  out.first_node = hierarchy.level_begin[level];
  list_images(finer.triangles, parent, out.triangles);
  out.edges.clear();
  for (const auto& [a, b] : finer.edges)
    if (parent[a] != parent[b]) out.edges.push_back({std::min(parent[a], parent[b]), std::max(parent[a], parent[b])});
  if (!out.edges.empty()) {
    std::sort(out.edges.begin(), out.edges.end());
    out.edges.erase(std::unique(out.edges.begin(), out.edges.end()), out.edges.end());
  }
  find_neighbours(hierarchy.level_size(level), out);
}

}  // namespace limber
