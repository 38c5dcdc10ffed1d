// SPDX-License-Identifier: Apache-2.0
// One level of the multilevel mesh as a mesh (Kircher & Garland 2005, section 3): its triangles, and the
// neighbours of every node in the order in which they stand around it.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/hierarchy/hierarchy.h"

namespace limber {

// How the triangles of a node lie around it. Where these face alike, each leads from one neighbour to the next.
enum class StarKind : unsigned char {
  kClosed,     // one closed fan: neighbours in cyclic order
  kBorder,     // one open fan: neighbours from border to border
  kIrregular,  // anything else (isolated, non-manifold): neighbours in no particular order
};

struct LevelGraph {
  Index first_node = 0;             // of the level; all indices below are of nodes, not counted from it
  std::vector<Triangle> triangles;  // the images of the finest triangles that have not degenerated, in their order
  std::vector<std::array<Index, 2>> edges;  // images of finest edges; kept only where triangles may vanish around them
  std::vector<Index> begin;                 // [level_size + 1], into neighbours
  std::vector<Index> neighbours;            // nodes joined by an edge, each once
  std::vector<StarKind> star;               // [level_size]

  Index size() const { return static_cast<Index>(star.size()); }
  std::span<const Index> around(Index node) const {
    const Index i = node - first_node;
    return {neighbours.data() + begin[i], begin[i + 1] - begin[i]};
  }
  StarKind star_of(Index node) const { return star[node - first_node]; }
};

// Makes level graphs; keeps its scratch memory between calls.
class LevelGraphBuilder {
 public:
  // The finest level. With keep_edges, edges are followed up the levels beside the triangles, which is needed where
  // contraction or swaps need not preserve the topology.
  void build_finest(const Mesh& mesh, bool keep_edges, LevelGraph& out);

  // Level `level` >= 1 of the hierarchy from the graph of the level below.
  void build_coarser(const Hierarchy& hierarchy, Index level, const LevelGraph& finer, LevelGraph& out);

 private:
  void find_neighbours(Index node_count, LevelGraph& graph);
  StarKind order_around(Index node, std::span<Index> neighbours);

  struct Incidence {
    Index from, to;  // the edge of a triangle across from a node, or an edge to `from` where `to` is kNone
  };
  std::vector<Index> incidence_begin_;
  std::vector<Incidence> incidences_;
  std::vector<Index> mark_;  // [nodes of the level]: position in the neighbours of the node at work
  struct Sides {
    Index other[2];
    unsigned count;
    bool leads;  // a triangle leads on from here
  };
  std::vector<Sides> sides_;  // of the neighbours of the node at work: who stands beside them
  std::vector<Index> ordered_;
};

}  // namespace limber
