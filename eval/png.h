// SPDX-License-Identifier: Apache-2.0
// Pictures as PNG files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "eval/image.h"
#include "limber/base/result.h"

namespace limber::eval {

// The bytes of a PNG file: RGB where all pixels are opaque, else RGBA; sRGB, no time stamp, so that the same picture
// gives the same bytes. Refuses a picture without pixels.
Result<std::vector<std::byte>> encode_png(const Image& image);

// Writes to a temporary name beside `path` and renames, so that a file of the final name is always whole. Replaces what
// was there.
Result<void> write_png(const std::string& path, const Image& image);

}  // namespace limber::eval
