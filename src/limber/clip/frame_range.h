// SPDX-License-Identifier: Apache-2.0
// Some frames of a clip, for readers that give all of theirs.
#pragma once

#include <memory>
#include <string>

#include "limber/base/result.h"
#include "limber/clip/clip.h"

namespace limber {

// The clip from options.first to options.last, where given; the frames before are read and passed over. Precondition:
// the reader knows its frame count and is before frame 0. Errors: those of check_range(); `where` names the clip.
Result<std::unique_ptr<ClipReader>> limit_frames(std::unique_ptr<ClipReader> reader, const ClipOptions& options,
                                                 const std::string& where);

}  // namespace limber
