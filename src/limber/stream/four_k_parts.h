// SPDX-License-Identifier: Apache-2.0
// Fronts of a four-face file of several parts, with one of the tiles in memory at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/fourface/front_request.h"
#include "limber/stream/four_k_decoder.h"

namespace limber {

struct PartsMesh {
  std::vector<Triangle> triangles;
  std::vector<Vec3f> positions;  // only vertices that a triangle uses
  std::vector<Index> numbers;    // [positions.size()]: of the input's vertices, ascending
};

// The least error with which at most so many triangles, or vertices, are left; the largest where there are more
// whatever it is. One pass over the file. Precondition for all that follow: decoder.is_whole().
Result<float> error_for_size(const FourKDecoder& decoder, std::uint64_t size,
                             FrontBudget unit = FrontBudget::kTriangles);

// The mesh that is left by the operations with at most this error: a conforming one, across the tiles' borders too, as
// errors do not fall from the tiles to what joins them. Memory: a part, and the result.
Result<PartsMesh> mesh_at_error(const FourKDecoder& decoder, float error);

// The mesh that the request asks for, which has neither a size, nor a level, nor bends. Where it has a viewpoint or a
// ball the file is read once more, for spheres of the first part that hold those of the tiles: with them the values
// do not fall from the tiles to what joins them, and the mesh is a conforming one.
Result<PartsMesh> mesh_for_request(const FourKDecoder& decoder, const FrontRequest& request);

// How the parts hang together: nothing where every finest triangle of the first part is a coarsest one of one tile, and
// the other way round, and no operation has a smaller error than those of the tile that it depends on; else what is
// wrong. Of a file of one part nothing.
Result<std::optional<std::string>> validate_joints(const FourKDecoder& decoder);

}  // namespace limber
