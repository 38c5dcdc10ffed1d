// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/validate.h"

#include <algorithm>

#include "limber/contract/edges.h"

namespace limber {

std::string Violation::line() const {
  std::string text = std::string(invariant) + " is broken at level " + std::to_string(level);
  if (node != kNone) text += ", node " + std::to_string(node);
  return text;
}

Index Validator::find(Index i) {
  while (union_[i] != i) i = union_[i] = union_[union_[i]];
  return i;
}

Validator::Validator(const Mesh& mesh, Topology topology)
    : mesh_(mesh),
      topology_(topology),
      edges_(find_edges(mesh).ends),
      component_(mesh.vertex_count, kNone),
      ancestor_(mesh.vertex_count),
      union_(mesh.vertex_count) {
  for (Index v = 0; v < mesh.vertex_count; ++v) union_[v] = v;
  for (const auto& [a, b] : edges_) union_[find(a)] = find(b);
  for (Index v = 0; v < mesh.vertex_count; ++v) {
    Index& component = component_[find(v)];
    if (component == kNone) component = component_count_++;
  }
  for (Index v = 0; v < mesh.vertex_count; ++v) component_[v] = component_[find(v)];
  if (topology_ != Topology::kPreserve) return;
  builder_.build_finest(mesh, false, finest_);
  finest_shapes_ = shapes(finest_, component_);
  is_manifold_.assign(component_count_, 1);
  for (Index v = 0; v < mesh.vertex_count; ++v)
    if (finest_.star_of(v) == StarKind::kIrregular) is_manifold_[component_[v]] = 0;
}

std::optional<Violation> Validator::check_tree(const Hierarchy& hierarchy) const {
  const auto& begin = hierarchy.level_begin;
  if (begin.size() < 2 || begin.front() != 0 || begin[1] != mesh_.vertex_count ||
      !std::is_sorted(begin.begin(), begin.end()) || begin.back() != hierarchy.parent.size())
    return Violation{"levels-nested", 0, kNone};
  std::vector<unsigned char> has_child(hierarchy.node_count(), 0);
  for (Index level = 0; level < hierarchy.level_count(); ++level) {
    const bool top = level + 1 == hierarchy.level_count();
    for (Index node = begin[level]; node < begin[level + 1]; ++node) {
      const Index parent = hierarchy.parent[node];
      if (top) {
        if (parent != kNone) return Violation{"top-has-no-parent", level, node};
        continue;
      }
      if (parent < begin[level + 1] || parent >= begin[level + 2]) return Violation{"parent-one-above", level, node};
      has_child[parent] = 1;
    }
  }
  for (Index level = 1; level < hierarchy.level_count(); ++level)
    for (Index node = begin[level]; node < begin[level + 1]; ++node)
      if (!has_child[node]) return Violation{"cluster-not-empty", level, node};
  return std::nullopt;
}

// A node's vertices are connected if joining the ends of all edges inside it leaves one set.
std::optional<Violation> Validator::check_connection(const Hierarchy& hierarchy, Index level) {
  for (Index v = 0; v < mesh_.vertex_count; ++v) union_[v] = v;
  for (const auto& [a, b] : edges_)
    if (ancestor_[a] == ancestor_[b]) union_[find(a)] = find(b);
  std::vector<Index> set_of_node(hierarchy.level_size(level), kNone);
  for (Index v = 0; v < mesh_.vertex_count; ++v) {
    Index& set = set_of_node[ancestor_[v] - hierarchy.level_begin[level]];
    if (set == kNone) set = find(v);
    if (set != find(v)) return Violation{"cluster-connected", level, ancestor_[v]};
  }
  return std::nullopt;
}

std::vector<Validator::Shape> Validator::shapes(const LevelGraph& graph,
                                                const std::vector<Index>& component_of_node) const {
  std::vector<Shape> shapes(component_count_);
  const auto shape_of = [&](Index node) -> Shape& { return shapes[component_of_node[node - graph.first_node]]; };
  Mesh mesh{graph.size(), graph.triangles};
  for (Triangle& t : mesh.triangles)
    for (Index& corner : t) corner -= graph.first_node;
  for (Index i = 0; i < graph.size(); ++i) ++shape_of(graph.first_node + i).euler_characteristic;
  for (const Triangle& t : graph.triangles) ++shape_of(t[0]).euler_characteristic;
  const Edges edges = find_edges(mesh);
  for (const auto& ends : edges.ends) --shape_of(ends[0] + graph.first_node).euler_characteristic;

  // Border loops: connected sets of border edges.
  std::vector<Index> loop(graph.size());
  for (Index i = 0; i < graph.size(); ++i) loop[i] = i;
  const auto root = [&loop](Index i) {
    while (loop[i] != i) i = loop[i] = loop[loop[i]];
    return i;
  };
  std::vector<unsigned char> on_border(graph.size(), 0);
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    if (edges.triangle_count[e] != 1) continue;
    on_border[edges.ends[e][0]] = on_border[edges.ends[e][1]] = 1;
    loop[root(edges.ends[e][0])] = root(edges.ends[e][1]);
  }
  for (Index i = 0; i < graph.size(); ++i)
    if (on_border[i] && root(i) == i) ++shape_of(graph.first_node + i).border_loop_count;
  return shapes;
}

std::optional<Violation> Validator::check_shape(const Hierarchy& hierarchy, Index level) {
  const Index first = hierarchy.level_begin[level], size = hierarchy.level_size(level);
  constexpr std::string_view kName = "manifold-kept";
  // The image of the finest level in one step, whatever lies between.
  Hierarchy direct{{0, mesh_.vertex_count, mesh_.vertex_count + size}, ancestor_};
  for (Index& node : direct.parent) node = node - first + mesh_.vertex_count;
  direct.parent.resize(mesh_.vertex_count + size, kNone);
  builder_.build_coarser(direct, 1, finest_, image_);

  std::vector<Index> component_of_node(size);
  std::vector<unsigned char> regular(size, 1);
  for (Index v = 0; v < mesh_.vertex_count; ++v) {
    component_of_node[ancestor_[v] - first] = component_[v];
    if (finest_.star_of(v) == StarKind::kIrregular) regular[ancestor_[v] - first] = 0;
  }
  for (Index i = 0; i < size; ++i)
    if (regular[i] && image_.star[i] == StarKind::kIrregular) return Violation{kName, level, first + i};

  const std::vector<Shape> image_shapes = shapes(image_, component_of_node);
  for (Index c = 0; c < component_count_; ++c)
    if (is_manifold_[c] && image_shapes[c] != finest_shapes_[c]) return Violation{kName, level, kNone};
  return std::nullopt;
}

std::optional<Violation> Validator::operator()(const Hierarchy& hierarchy) {
  if (auto violation = check_tree(hierarchy)) return violation;
  for (Index v = 0; v < mesh_.vertex_count; ++v) ancestor_[v] = v;
  for (Index level = 1; level < hierarchy.level_count(); ++level) {
    for (Index& node : ancestor_) node = hierarchy.parent[node];
    if (auto violation = check_connection(hierarchy, level)) return violation;
    if (topology_ == Topology::kPreserve)
      if (auto violation = check_shape(hierarchy, level)) return violation;
  }
  return std::nullopt;
}

}  // namespace limber
