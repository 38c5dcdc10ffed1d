// SPDX-License-Identifier: Apache-2.0
// A hierarchy that may change, and what its clusters weigh in one frame: their quadrics, summed up the levels, and
// where these are least (Kircher & Garland 2005, section 3). Which way they face is summed up beside.
#pragma once

#include <span>
#include <vector>

#include "limber/base/facing.h"
#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/hierarchy/child_lists.h"
#include "limber/hierarchy/hierarchy.h"

namespace limber {

class Clustering {
 public:
  explicit Clustering(Hierarchy base);

  const Hierarchy& hierarchy() const { return hierarchy_; }
  const ChildLists& children() const { return children_; }
  Index parent(Index node) const { return hierarchy_.parent[node]; }
  bool has_one_child(Index node) const {
    const Index child = children_.first_child(node);
    return child != kNone && children_.next_sibling(child) == kNone;
  }

  // [vertex_count], of the frame: to be filled before weigh().
  std::span<Quadric> finest_quadrics() { return std::span(quadrics_).first(hierarchy_.vertex_count()); }
  std::span<Facing> finest_facings() { return std::span(facings_).first(hierarchy_.vertex_count()); }
  std::span<Vec3d> finest_positions() { return std::span(minima_).first(hierarchy_.vertex_count()); }

  // Takes the parents of a hierarchy with the same level sizes. To be followed by weigh().
  void replace(const Hierarchy& hierarchy);

  // Sums what is known of the finest vertices up the levels, in the order of the nodes, and finds all minima: what
  // comes of it depends on the hierarchy alone, not on how it came about.
  void weigh();

  // The node and all below it leave its parent for `to`, one level above it, with their sums. What this changes is
  // weighed anew.
  void move(Index node, Index to);

  // [node_count] each; of the finest nodes the minima are their positions and the energies 0.
  std::span<const Quadric> quadrics() const { return quadrics_; }
  std::span<const Facing> facings() const { return facings_; }
  std::span<Vec3d> minima() { return minima_; }
  std::span<const double> energies() const { return energies_; }
  const Quadric& quadric(Index node) const { return quadrics_[node]; }
  const Facing& facing(Index node) const { return facings_[node]; }
  const Vec3d& minimum_at(Index node) const { return minima_[node]; }
  // The least error of the node's quadric.
  double energy(Index node) const { return energies_[node]; }
  // Sum over a level.
  double total_energy(Index level) const;

 private:
  void place(Index node);

  Hierarchy hierarchy_;
  ChildLists children_;
  std::vector<Quadric> quadrics_;  // [node_count]
  std::vector<Facing> facings_;    // [node_count]
  std::vector<Vec3d> minima_;      // [node_count]
  std::vector<double> energies_;   // [node_count]
};

}  // namespace limber
