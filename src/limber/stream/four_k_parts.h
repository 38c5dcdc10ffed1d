// SPDX-License-Identifier: Apache-2.0
// Fronts of a four-face file of several parts, with one of the tiles in memory at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/stream/four_k_decoder.h"

namespace limber {

struct PartsMesh {
  std::vector<Triangle> triangles;
  std::vector<Vec3f> positions;  // only vertices that a triangle uses
  std::vector<Index> numbers;    // [positions.size()]: of the input's vertices, ascending
};

// The least error with which at most so many triangles are left; the largest where there are more whatever it is. One
// pass over the file. Precondition for both: decoder.is_whole().
Result<float> error_for_triangles(const FourKDecoder& decoder, std::uint64_t triangles);

// The mesh that is left by the operations with at most this error: a conforming one, across the tiles' borders too, as
// errors do not fall from the tiles to what joins them. Memory: a part, and the result.
Result<PartsMesh> mesh_at_error(const FourKDecoder& decoder, float error);

}  // namespace limber
