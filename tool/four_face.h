// SPDX-License-Identifier: Apache-2.0
// What the verbs do where the file is a four-face file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eval/four_face_levels.h"
#include "limber/base/result.h"
#include "limber/stream/build_four_k_file.h"
#include "limber/stream/four_k_decoder.h"
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

// The same where the file has several parts. Throws UsageError where the request is not for such a file.
Result<Exit> extract_parts(const FourFaceExtract& arguments, const eval::FourFaceRequest& request,
                           const StreamFile& file, const FourKDecoder& decoder, Console& console);

// What came out of a frame.
struct ExtractedFront {
  std::uint32_t number = 0;
  std::size_t vertices = 0, triangles = 0;
  std::optional<double> error;  // the largest of an operation that is applied, in percent
};
void report_four_face(const FourFaceExtract& arguments, const eval::FourFaceRequest& request,
                      const std::vector<ExtractedFront>& all, Console& console);

}  // namespace limber::tool
