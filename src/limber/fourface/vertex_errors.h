// SPDX-License-Identifier: Apache-2.0
// What each vertex stands for: a quadric, its own faces' and what it has been given of those that were removed (Velho
// 2001, "Measuring Error with Quadrics").
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/contract/vertex_quadrics.h"
#include "limber/fourface/face_table.h"

namespace limber {

class VertexErrors {
 public:
  // positions: [mesh.vertex_count x frame_count], those of a vertex in all frames together, normalized alike.
  // is_closed: the mesh has no border edges, so that nobody needs to look for them.
  VertexErrors(const Mesh& mesh, std::vector<Vec3d> positions, std::size_t frame_count, const QuadricOptions& options,
               bool is_closed = false);

  std::span<const Vec3d> positions() const { return positions_; }
  std::span<const Quadric> quadrics() const { return quadrics_; }
  std::span<const double> own_errors() const { return own_error_; }  // [vertex_count]: Q_v(v), of all frames together
  std::size_t frame_count() const { return frame_count_; }

  // (Q_v + Q_u)(u): C(v) with u for the neighbour, of all frames together, >= 0.
  double removal_cost(Index v, Index u) const {
    double sum = own_error_[u];
    for (std::size_t f = 0; f < frame_count_; ++f) sum += quadrics_[v * frame_count_ + f](at(u, f));
    return std::max(sum, 0.0);
  }

  // The same for all neighbours of star.center, in the order of the ring. costs: at least [star.count].
  void removal_costs(const Star& star, std::span<double> costs) const;

  // The square of the sum of the weights of the planes that v stands for, which are areas; of all frames together.
  double squared_weight(Index v) const {
    double sum = 0;
    for (std::size_t f = 0; f < frame_count_; ++f) {
      const double weight = quadrics_[v * frame_count_ + f].trace();
      sum += weight * weight;
    }
    return sum;
  }

  // The planes that stand on the edge, at right angles to its faces, hold a line in place as they do a border.
  void hold_line(const FaceTable& faces, Index half_edge);

  // The least C(v), before removal_weight; infinite where FaceTable::gather() is false.
  double least_removal(const FaceTable& faces, Index v) const;

  // How far apart the diagonals v r and s t of a quad are, at most.
  double swap_error(Index v, Index r, Index s, Index t) const;
  // How far u is, as the root of the mean square, from the planes that v stands for.
  double removal_error(Index v, Index u) const;

  // Whether a triangle, of these corners and this normal of any length in the frame, faces away from the surface that
  // the mesh was at first around each of its corners.
  bool is_inverted(const std::array<Index, 3>& corners, std::size_t frame, const Vec3d& normal) const {
    for (const Index v : corners)
      if (!(dot(normal, static_cast<Vec3d>(normals_[v * frame_count_ + frame])) < 0)) return false;
    return true;
  }

  // v is removed: u and w stand for what it stood for; u alone where they are the same.
  void share(Index v, Index u, Index w);

  // Asks for the memory that planning the removal of v, or of a neighbour of v, will need.
  void fetch_quadric(Index v) const { fetch(&quadrics_[v * frame_count_]), fetch(&quadrics_[v * frame_count_].c); }
  void fetch_position(Index v) const {
    fetch(&positions_[v * frame_count_]), fetch(&own_error_[v]), fetch(&normals_[v * frame_count_]);
  }

 private:
  const Vec3d& at(Index v, std::size_t frame) const { return positions_[v * frame_count_ + frame]; }
  void sum_own(Index v);
  void find_normals(const Mesh& mesh);

  QuadricOptions options_;
  std::size_t frame_count_;
  std::vector<Vec3d> positions_;   // [vertex_count x frame_count]
  std::vector<Quadric> quadrics_;  // [vertex_count x frame_count]
  std::vector<double> own_error_;
  std::vector<Vec3f> normals_;  // [vertex_count x frame_count]: of length 1 or 0
};

}  // namespace limber
