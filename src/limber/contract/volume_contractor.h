// SPDX-License-Identifier: Apache-2.0
// Edge contraction by what it changes in the current surface (Lindstrom & Turk 1998, "Fast and memory efficient
// polygonal simplification").
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/contract/contraction.h"
#include "limber/contract/symmetric_matrix.h"
#include "limber/contract/volume_placement.h"

namespace limber {

// Contracts the edges of one frame, cheapest first; for what they cost see volume_placement.h.
class VolumeContractor final : public Contraction {
 public:
  // positions: [mesh.vertex_count], finite; need not live on. go_on is asked here and in contract_to(): before each
  // pass over the mesh, and about every thousand edges. Of the options only `topology` is looked at.
  VolumeContractor(const Mesh& mesh, std::span<const Vec3f> positions, const ContractOptions& options,
                   GoOnFunction go_on = {});

  Index contract_to(Index target) override;

  // frame: 0.
  Vec3f position(Index representative, std::size_t frame) const override;

 private:
  struct Met {
    Index round = 0;
    std::array<Index, 2> triangles{};
  };

  // In five steps, the first 0, each some time after the one before.
  void fetch_step(Index edge, int step) const;
  void fetch_ahead() const;
  void update_facet(Index triangle);
  const SymmetricMatrix& star(Index v);
  void update_star(Index v);
  VolumePlacement placement(Index edge);
  float cost(Index edge);
  bool folds_over(Index edge, const Vec3d& point);
  void apply(Index edge, const Vec3d& point);

  Topology topology_;
  Normalization normalization_;
  std::vector<Vec3d> positions_;           // [vertex_count], normalized
  std::vector<Facet> facets_;              // [triangle count]
  std::vector<SymmetricMatrix> stars_;     // [vertex_count]
  std::vector<std::uint8_t> is_old_star_;  // [vertex_count]: whether the surface around it has changed since

  std::vector<Met> met_;  // [vertex_count], scratch: the triangles that join it to the centre of this round
  Index round_ = 0;
  std::vector<Index> ring_, again_;  // scratch
};

}  // namespace limber
