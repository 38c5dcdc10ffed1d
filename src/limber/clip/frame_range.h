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

// The first frame of a clip and every step-th after it, numbered on from the first; those between are read and passed
// over. Precondition: step >= 1.
std::unique_ptr<ClipReader> every_nth(std::unique_ptr<ClipReader> reader, std::uint32_t step);

}  // namespace limber
