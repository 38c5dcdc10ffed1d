// SPDX-License-Identifier: Apache-2.0
// Pictures of frames, into files.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "eval/mesh_source.h"
#include "eval/picture.h"
#include "tool/console.h"
#include "tool/output_argument.h"

namespace limber::tool {

using OpenMeshes = std::function<Result<std::unique_ptr<eval::MeshSource>>()>;

struct PictureJob {
  eval::PictureOptions options;
  OpenMeshes open_level;           // what is shown, a picture per frame
  OpenMeshes open_original;        // as many frames; may be empty where the options need none
  OpenMeshes open_space;           // the frames that the camera has room for
  std::optional<Camera> camera{};  // in its place
};

struct PicturedFrame {
  std::uint32_t number = 0;
  Index vertices = 0, triangles = 0;
};

struct TakenPictures {
  std::vector<PicturedFrame> frames;
  std::optional<double> error_range;
};

// All pictures from one place, numbered as the level's frames, all written or none.
Result<TakenPictures> take_pictures(const PictureJob& job, const OutputArgument& output, Console& console);

}  // namespace limber::tool
