// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "limber/base/result.h"
#include "limber/clip/clip.h"
#include "tool/console.h"
#include "tool/output_argument.h"

namespace limber::tool {

// Writes all frames of a clip, numbered as the source numbers them, and reports how many.
Result<Exit> copy_clip(ClipReader& reader, const OutputArgument& output, std::string_view schema, Console& console);

}  // namespace limber::tool
