// SPDX-License-Identifier: Apache-2.0
// A height field of any size in, a four-face file out, with a tile in memory at a time (Velho 2001, "Out-of-core").
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "limber/base/result.h"
#include "limber/fourface/build_four_k.h"
#include "limber/stream/four_k_encoder.h"

namespace limber {

// Heights above a grid. The vertex of a row and column is row * width + column, and lies at (column, height, row).
struct HeightField {
  Index width = 0, depth = 0;      // vertices, at least 2; width * depth at most kMostNodes
  double lowest = 0, highest = 0;  // of all heights, or beyond them
  // Fills in the heights of a row from a column on.
  std::function<Result<void>(Index row, Index column, std::span<float> heights)> read;
};

struct HeightFieldOptions {
  Index tile = 512;                 // cells of a tile, each way, >= 2
  double tile_share = 0.015;        // of a tile's triangles that are left where the seams are taken up
  double tolerance = 1.0 / 100000;  // as in EncoderOptions, of the whole field's diagonal
  unsigned threads = 1;
};

struct HeightFieldReport {
  std::uint32_t tile_count = 0;
  std::uint64_t finest_count = 0;  // triangles
  Index seam_count = 0;            // triangles left of all tiles, where the first part begins
  Index coarsest_count = 0;
  std::uint64_t operation_count = 0;
  std::uint64_t file_bytes = 0;
};

// Every tile is simplified with its border as it is; then all together, as one mesh, to the last, which makes the seams
// coarse too. The tiles are parts 1, 2, ... of the file, what joins them is part 0, whose finest triangles are the
// coarsest of the tiles. go_on(tiles done). Errors: those of the field and the sink; kCancelled.
Result<HeightFieldReport> build_height_field(const HeightField& field, const HeightFieldOptions& options,
                                             const ByteSink& sink,
                                             const std::function<bool(std::uint32_t)>& go_on = {});

}  // namespace limber
