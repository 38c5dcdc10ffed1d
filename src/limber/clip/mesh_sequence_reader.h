// SPDX-License-Identifier: Apache-2.0
// A clip as a mesh file per frame.
#pragma once

#include <memory>

#include "limber/base/result.h"
#include "limber/clip/clip.h"
#include "limber/clip/frame_files.h"

namespace limber {

// Reads the first frame, whose connectivity is that of the clip. A later frame that differs in its vertex count,
// its triangle count or any triangle is a kMismatch that names the file and the difference.
Result<std::unique_ptr<ClipReader>> open_mesh_sequence(FrameFiles files);

}  // namespace limber
