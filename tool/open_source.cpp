// SPDX-License-Identifier: Apache-2.0
#include "tool/open_source.h"

#include <fmt/format.h>

#include "limber/clip/input_file.h"
#include "tool/exit.h"

namespace limber::tool {

bool is_stream(std::string_view path) { return lower_case_extension(path) == ".limber"; }

Result<std::unique_ptr<eval::MeshSource>> open_any_meshes(const ClipArgument& argument,
                                                          const eval::LevelChoice& level) {
  if (is_stream(argument.specification)) {
    return eval::open_stream_meshes(argument.specification, level, argument.options);
  }
  if (level.cut || level.view || level.blend > 0) {
    throw UsageError(
        fmt::format("only a .limber stream has levels of detail, and {} is none; leave out --vertices, "
                    "--triangles, --level, --error, --pixels and --blend",
                    argument.specification));
  }
  return eval::open_meshes(argument.specification, argument.options);
}

Result<std::unique_ptr<eval::MeshSource>> open_original(const ClipArgument& argument) {
  if (is_stream(argument.specification)) {
    return eval::open_stream_meshes(argument.specification, {}, argument.options);
  }
  Result<std::unique_ptr<ClipReader>> clip = open_any_clip(argument);
  if (!clip) return clip.error();
  return eval::meshes_of(std::move(*clip));
}

}  // namespace limber::tool
