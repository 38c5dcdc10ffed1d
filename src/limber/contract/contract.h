// SPDX-License-Identifier: Apache-2.0
// Edge contraction under quadric error functions (QSlim: Garland & Heckbert 1997), for one frame or for many frames
// at once (Mohr & Gleicher 2003): simplification, and the clusters that hierarchies are built from.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/contract/contraction.h"
#include "limber/contract/fetch.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber {

// Changes the quadrics of the vertices in a frame, [mesh.vertex_count], before anything is contracted. They are given
// in coordinates normalized by the frame's normalization() with the scale of the first frame's, must stay positive
// definite (see base/quadric.h), and may be replaced altogether.
using ChangeQuadricsFunction = std::function<void(std::size_t frame, std::span<Quadric> quadrics)>;

// Contracts edges, cheapest first, and can be asked for smaller and smaller vertex counts. The cost of an edge in a
// frame is the smallest value of the sum of its ends' quadrics, each frame with a minimum of its own; its cost is the
// sum over the frames, or what options.frame_cost says.
class Contractor final : public Contraction {
 public:
  // frames: at least one; each [mesh.vertex_count], finite. Neither need live on. go_on is asked here and in
  // contract_to(): before each pass over the mesh, of which a frame takes one, and about every thousand edges.
  // options.placement must be kQuadric.
  Contractor(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames, const ContractOptions& options,
             GoOnFunction go_on = {}, const ChangeQuadricsFunction& change_quadrics = {});

  Index contract_to(Index target) override;

  // The minimum of the representative's quadric.
  Vec3f position(Index representative, std::size_t frame) const override;

 private:
  float cost(Index edge) const;
  void fetch_quadric(Index v) const {
    const Quadric& quadric = quadrics_[v * frame_count_];
    fetch(&quadric.xx);
    fetch(&quadric.c);
  }
  void fetch_ahead() const;
  bool folds_over(Index edge);
  void apply(Index edge);

  ContractOptions options_;
  std::size_t frame_count_;
  std::vector<Normalization> normalizations_;  // [frame_count]
  std::vector<Quadric> quadrics_;              // [vertex_count x frame_count]
  std::vector<Vec3f> positions_;               // [vertex_count x frame_count], normalized; single precision, so that
                                               // more of them are in the cache
  std::vector<Vec3d> minima_;                  // [frame_count], scratch
};

// One frame's contraction with options.placement. `positions` need not live on; go_on as for Contractor.
std::unique_ptr<Contraction> start_contraction(const Mesh& mesh, std::span<const Vec3f> positions,
                                               const ContractOptions& options, GoOnFunction go_on = {});

struct Simplified {
  Mesh mesh;                     // only vertices that a triangle uses
  std::vector<Vec3f> positions;  // [mesh.vertex_count]
  std::vector<Index> vertices;   // [mesh.vertex_count]: the representative, an index of the input
};

// One frame to at most `vertex_count` vertices, or as near as the topology allows.
Simplified simplify(const Mesh& mesh, std::span<const Vec3f> positions, Index vertex_count,
                    const ContractOptions& options);

// What a contraction has come to, in one frame.
Simplified simplified_mesh(const Contraction& contraction, const Mesh& mesh, std::size_t frame);

}  // namespace limber
