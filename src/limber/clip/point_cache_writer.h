// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>

#include "limber/base/result.h"
#include "limber/clip/clip.h"
#include "limber/clip/point_cache_layout.h"

namespace limber {

// Writes a point cache, and the mesh of the first frame beside it: out.obj for out.pc2. Errors: those of OutputFile;
// finish() without a frame is kBadInput.
Result<std::unique_ptr<ClipWriter>> create_point_cache(const std::filesystem::path& path, PointCacheFormat format,
                                                       const Mesh& mesh, const ClipWriterOptions& options);

}  // namespace limber
