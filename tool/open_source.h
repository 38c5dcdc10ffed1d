// SPDX-License-Identifier: Apache-2.0
// Opens what verbs look at: meshes frame by frame, from files, clips and streams.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "eval/mesh_source.h"
#include "tool/clip_argument.h"

namespace limber::tool {

// By its extension.
bool is_stream(std::string_view path);

// Meshes that need not have one connectivity. A level is for streams only: UsageError for anything else.
Result<std::unique_ptr<eval::MeshSource>> open_any_meshes(const ClipArgument& argument,
                                                          const eval::LevelChoice& level = {});

// Meshes of one connectivity; of a stream, its finest level.
Result<std::unique_ptr<eval::MeshSource>> open_original(const ClipArgument& argument);

}  // namespace limber::tool
