// SPDX-License-Identifier: Apache-2.0
// What the verbs do where the file is a four-face file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "limber/base/result.h"
#include "limber/stream/build_four_k_file.h"
#include "tool/clip_argument.h"
#include "tool/console.h"
#include "tool/exit.h"
#include "tool/level_argument.h"
#include "tool/output_argument.h"
#include "tool/picture_argument.h"
#include "tool/stream_file.h"
#include "tool/view_argument.h"

namespace limber::tool {

// build --structure four-face: the clip to the sink; prints and reports what came of it.
Result<void> build_four_face(ClipReader& clip, const BuildFourKOptions& options, const ByteSink& sink,
                             const std::string& output, Console& console);

Result<Exit> info_four_face(const StreamFile& file, Console& console);
Result<Exit> check_four_face(const StreamFile& file, Console& console);

struct FourFaceExtract {
  ClipArgument stream;
  LevelArgument level;
  ViewArgument view;
  OutputArgument output;
  PictureArgument picture;
};
Result<Exit> extract_four_face(const FourFaceExtract& arguments, Console& console);

}  // namespace limber::tool
