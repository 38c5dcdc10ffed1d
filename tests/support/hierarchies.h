// SPDX-License-Identifier: Apache-2.0
// Hierarchies drawn by hand and made at random.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "limber/contract/contract.h"
#include "limber/hierarchy/build.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/level_graph.h"
#include "tests/support/shapes.h"

namespace limber::test {

// Clusters of a sheet (support/shapes.h) drawn as one letter for each vertex, the row y = 0 first: the nodes of level 1
// in the order of their letters. `groups`, where given, draws the clusters of those: a letter for each of them.
inline Hierarchy drawn(const std::vector<std::string>& rows, const std::string& groups = "") {
  std::string letters;
  for (const std::string& row : rows) letters += row;
  Hierarchy h{{0, static_cast<Index>(letters.size())}, {}};
  const auto add_level = [&h](const std::string& labels) {
    std::map<char, Index> node_of;
    for (const char c : labels) node_of[c] = 0;
    Index next = h.level_begin.back();
    for (auto& [letter, node] : node_of) node = next++;
    for (const char c : labels) h.parent.push_back(node_of[c]);
    h.level_begin.push_back(next);
  };
  add_level(letters);
  if (!groups.empty()) add_level(groups);
  h.parent.resize(h.level_begin.back(), kNone);
  return h;
}

// The node of level 1 that a letter of drawn() stands for.
inline Index drawn_node(const std::vector<std::string>& rows, char letter) {
  std::string letters;
  for (const std::string& row : rows) letters += row;
  std::sort(letters.begin(), letters.end());
  letters.erase(std::unique(letters.begin(), letters.end()), letters.end());
  std::string all;
  for (const std::string& row : rows) all += row;
  return static_cast<Index>(all.size() + letters.find(letter));
}

inline Hierarchy built(const Shape& shape, double branching, Topology topology) {
  BuildOptions options;
  options.branching = branching;
  options.contract.topology = topology;
  const std::span<const Vec3f> frames[] = {shape.positions};
  return build_hierarchy(shape.mesh, frames, options);
}

// The graph of one level, from the finest up.
inline LevelGraph graph_of(const Mesh& mesh, const Hierarchy& hierarchy, Index level, bool keep_edges) {
  LevelGraphBuilder builder;
  LevelGraph graph, coarser;
  builder.build_finest(mesh, keep_edges, graph);
  for (Index k = 1; k <= level; ++k) {
    builder.build_coarser(hierarchy, k, graph, coarser);
    std::swap(graph, coarser);
  }
  return graph;
}

// [vertex_count]: the node of a level that a finest vertex belongs to.
inline std::vector<Index> ancestors(const Hierarchy& hierarchy, Index level) {
  std::vector<Index> node(hierarchy.vertex_count());
  for (Index v = 0; v < hierarchy.vertex_count(); ++v) {
    node[v] = v;
    for (Index k = 0; k < level; ++k) node[v] = hierarchy.parent[node[v]];
  }
  return node;
}

// The triangles of a level as sets of nodes, each once.
inline std::set<Triangle> triangles_of(const Mesh& mesh, const Hierarchy& hierarchy, Index level) {
  std::set<Triangle> images;
  const std::vector<Index> at = ancestors(hierarchy, level);
  for (const Triangle& t : mesh.triangles) {
    Triangle image{at[t[0]], at[t[1]], at[t[2]]};
    std::sort(image.begin(), image.end());
    if (!is_degenerate(image)) images.insert(image);
  }
  return images;
}

}  // namespace limber::test
