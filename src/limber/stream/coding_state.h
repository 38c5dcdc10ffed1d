// SPDX-License-Identifier: Apache-2.0
// Everything that coding a frame leaves for the next one, the same when writing and when reading. Part of the player.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/stream/clusters.h"
#include "limber/stream/coarser_positions.h"
#include "limber/stream/error_coding.h"
#include "limber/stream/finest_positions.h"
#include "limber/stream/hierarchy_coding.h"
#include "limber/stream/neighbors.h"
#include "limber/stream/residuals.h"
#include "limber/stream/traversal.h"

namespace limber {

// Not movable: its parts refer to each other.
struct CodingState {
  // `lossless`: whether the stream is, so that lattice points are no coordinates.
  CodingState(const Mesh& mesh, std::span<const Index> level_begin, bool lossless);
  CodingState(const CodingState&) = delete;
  CodingState& operator=(const CodingState&) = delete;

  // A key frame follows: nothing of the past is used.
  void reset_models();

  IndexLists neighbors;
  Traversal traversal;
  Clusters clusters;
  FinestPositions finest;
  CoarserPositions coarser;
  ResidualStatistics finest_statistics, coarser_statistics;
  HierarchyModels hierarchy_models;
  ErrorState errors;
  std::vector<Index> order;  // [node_count]: scratch

 private:
  CodingState(const Mesh& mesh, std::span<const Index> level_begin, bool lossless, const IndexLists& incident);
};

}  // namespace limber
