// SPDX-License-Identifier: Apache-2.0
// A clip as a point cache (PC2 or MDD) and the mesh whose vertices it moves.
#pragma once

#include <filesystem>
#include <memory>

#include "limber/base/result.h"
#include "limber/clip/clip.h"
#include "limber/clip/point_cache_layout.h"

namespace limber {

// The mesh is options.mesh, or the mesh file beside the cache: of the same name (out.obj for out.pc2), or the only
// one. Errors: those of read_mesh and read_point_cache_layout; kNotFound where there is no mesh, kBadInput where there
// are several (they are listed); kMismatch where its vertex count is not the cache's point count.
// Frames are read one by one; files may be larger than 4 GB.
Result<std::unique_ptr<ClipReader>> open_point_cache(const std::filesystem::path& path, PointCacheFormat format,
                                                     const ClipOptions& options);

}  // namespace limber
