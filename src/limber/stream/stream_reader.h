// SPDX-License-Identifier: Apache-2.0
// A stream as a clip: the positions of its finest vertices, frame by frame.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "limber/base/result.h"
#include "limber/clip/clip.h"

namespace limber {

// `bytes` are kept by reference; `name` stands in errors. Errors: those of Decoder::open(); those of check_range();
// later, when they are read, broken frames, and kTruncated where the stream ends before its last frame.
Result<std::unique_ptr<ClipReader>> open_stream_clip(std::span<const std::byte> bytes, const ClipOptions& options,
                                                     const std::string& name);

}  // namespace limber
