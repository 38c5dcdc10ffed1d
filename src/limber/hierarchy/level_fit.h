// SPDX-License-Identifier: Apache-2.0
// Where a level's nodes stand: near the minima of their quadrics, and so that the surface of the level is near the
// finest one.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "limber/base/facing.h"
#include "limber/base/mesh.h"
#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/hierarchy/fan.h"
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

  // Moves all nodes above the finest level. quadrics, facings: [node_count], of the clusters; positions: [node_count],
  // the finest as they are, the others at the minima of their quadrics; errors: [node_count], the squared distance of
  // each node's cluster over its area. Those of nodes with triangles become what is left of it: the mean of that of the
  // samples to the level's surface and, by half the quadric, that of the nodes to the finest surface. Samples do not
  // see what of the level sticks out from among them, nor nodes what of the finest surface does.
  void fit(std::span<const Quadric> quadrics, std::span<const Facing> facings, const FitOptions& options,
           std::span<Vec3d> positions, std::span<double> errors);

 private:
  struct Side {
    Index a, b;  // of a triangle: the corners beside a node
  };
  struct Sample {
    Vec3d point;
    double area;
  };
  // What pulls at a node, as a function of how far it moves: the weighted sum of ((r - move).d)^2.
  struct Pull {
    Float4 squares{};   // of xx, yy, zz and of r
    Float4 products{};  // of xy, xz, yz
    Float4 force{};     // x, y, z

    void add(const Pull& o, float share) {
      squares += o.squares * share;
      products += o.products * share;
      force += o.force * share;
    }
  };
  // Four of them, the same number of each side by side.
  struct Pulls {
    Float4 squares[4]{}, products[3]{}, force[3]{};

    void add(const Pulls& o, Float4 share) {
      for (int i = 0; i < 4; ++i) squares[i] += o.squares[i] * share;
      for (int i = 0; i < 3; ++i) products[i] += o.products[i] * share, force[i] += o.force[i] * share;
    }
    std::array<Pull, 4> each() const;
  };

  void go_up(Index level);
  Index sample_level(Index level) const;
  bool has_centroids() const;
  Index cluster_of(const Triangle& triangle) const;
  void find_members(Index level, std::span<const Vec3d> positions);
  Sample centroid(std::size_t triangle, std::span<const Vec3d> positions) const;
  void look_around(Index node, std::span<const Vec3d> positions);
  void pull_towards(const Vector4& points, Float4 weights, Pulls& at_node);
  void pull(std::span<const Vec3d> positions, bool roughly);
  void move(std::span<const Quadric> quadrics, double anchor, std::span<Vec3d> positions, std::span<double> errors);
  bool is_turned_over(const Triangle& triangle, std::span<const Vec3d> positions) const;
  void draw_back(const Triangle& triangle, double share, std::span<Vec3d> positions);
  void turn_back(std::span<Vec3d> positions);

  const Mesh& mesh_;
  const Hierarchy& hierarchy_;
  std::span<const Facing> facings_;  // of the fit at work

  // Of the level at work:
  Index first_ = 0, end_ = 0;        // nodes
  std::vector<Vec3d> minima_;        // [level_size]
  std::vector<Triangle> triangles_;  // images of the finest that have not degenerated
  std::vector<Index> fan_begin_;     // [level_size + 1], into fans_
  std::vector<Side> fans_;           // triangles around each node
  Index samples_ = 0;                // the sample level
  std::vector<Index> clusters_;      // [size of the sample level]
  std::vector<Index> member_begin_;  // [level_size + 1], into members_
  std::vector<Sample> members_;      // nodes of the sample level, after the finest the middles of triangles, by cluster
  std::vector<Pull> pulls_;          // [level_size]
  Fan fan_;                          // of the node at work
  std::vector<Index> drawn_back_;    // nodes
};

}  // namespace limber
