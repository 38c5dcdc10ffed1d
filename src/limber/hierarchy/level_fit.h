// SPDX-License-Identifier: Apache-2.0
// Where a level's nodes stand: near the minima of their quadrics, and so that the surface of the level is near the
// finest one.
#pragma once

#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/hierarchy/hierarchy.h"

namespace limber {

struct FitOptions {
  // Each finds the closest points anew, >= 0. 0: nodes stay at the minima of their quadrics, as in the papers.
  unsigned rounds = 2;
  // Weight of the quadric of a node's cluster beside the squared distances to the level's surface, > 0.
  double anchor = 1;
};

// Keeps its scratch memory between calls.
class LevelFit {
 public:
  // Both must outlive this object. The hierarchy may change its parents between calls.
  LevelFit(const Mesh& mesh, const Hierarchy& hierarchy);

  // Moves all nodes above the finest level. vertex_areas: [vertex_count], VertexQuadrics::areas(); quadrics:
  // [node_count], of the clusters; positions: [node_count], the finest as they are, the others at the minima of their
  // quadrics.
  void fit(std::span<const double> vertex_areas, std::span<const Quadric> quadrics, const FitOptions& options,
           std::span<Vec3d> positions);

 private:
  // A triangle as seen from one of its corners, the origin.
  struct Wedge {
    Vec3d to_a, to_b;                    // the other corners
    double aa, ab, bb;                   // scalar products of these
    double by_det, by_aa, by_bb, by_cc;  // reciprocals; cc is the side across from the origin. 0 where there is none
    Index a, b;
  };
  // A point on a wedge.
  struct Place {
    double gain = -1;     // by how much its squared distance is less than that of the origin
    double a = 0, b = 0;  // barycentric
    const Wedge* wedge = nullptr;
  };
  // What pulls at a node: sum of w dd', and of w r, with r the way to the finest surface and d its direction.
  struct Pull {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    Vec3d force{};
  };

  void sum_areas(std::span<const double> vertex_areas);
  void go_up(Index level);
  Index sample_level(Index level) const;
  void find_members(Index level);
  void look_around(Index node, std::span<const Vec3d> positions);
  Place closest(const Vec3d& point) const;
  void pull_towards(const Vec3d& point, double weight, Index node);
  void move(Index node, const Quadric& quadric, double anchor, Vec3d& position) const;

  const Mesh& mesh_;
  const Hierarchy& hierarchy_;
  Index first_ = 0;                  // node of the level at work
  std::vector<double> areas_;        // [node_count], of clusters
  std::vector<Triangle> triangles_;  // of the level at work: images of the finest that have not degenerated
  std::vector<Index> fan_begin_;     // [level_size + 1], into fans_
  std::vector<Index> fans_;          // triangles around each node
  std::vector<Index> member_begin_;  // [level_size + 1], into members_
  std::vector<Index> members_;       // nodes of the sample level, by cluster
  std::vector<Index> clusters_;      // [size of the sample level]
  std::vector<Wedge> wedges_;        // around the node at work
  std::vector<Pull> pulls_;          // [level_size]
};

}  // namespace limber
