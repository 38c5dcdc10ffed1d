// SPDX-License-Identifier: Apache-2.0
// Approximations in, one at a time, whatever they come from. The connectivity may change from frame to frame.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "eval/level_choice.h"
#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/clip/clip.h"

namespace limber::eval {

// The caller's object, used again for each frame.
struct SourceMesh {
  std::vector<Triangle> triangles;
  std::vector<Vec3f> positions;
  // [positions.size()]: ids that mean the same in every frame; empty where the source does not know.
  std::vector<Index> nodes;
};

class MeshSource {
 public:
  virtual ~MeshSource() = default;

  // Where the source knows it without reading all frames.
  virtual std::optional<std::uint32_t> frame_count() const = 0;

  // The number of the first frame, as the source numbers them.
  virtual std::uint32_t first_frame_number() const = 0;

  // The next frame: true; false, and `mesh` as it was, after the last. An error names the file and the place in it.
  virtual Result<bool> read(SourceMesh& mesh) = 0;
};

// A mesh file per frame, each read by itself: a printf pattern, glob, folder or single file as open_clip() takes them.
// Everything else that open_clip() opens: its frames.
Result<std::unique_ptr<MeshSource>> open_meshes(std::string_view specification, const ClipOptions& options);

// The frames of a clip.
std::unique_ptr<MeshSource> meshes_of(std::unique_ptr<ClipReader> clip);

// A level of every frame of a stream file between options.first and options.last.
Result<std::unique_ptr<MeshSource>> open_stream_meshes(std::string_view path, const LevelChoice& level,
                                                       const ClipOptions& options);

}  // namespace limber::eval
