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

// Meshes that need not have one connectivity. A cut, and over how many frames its changes are blended, are for streams
// only: UsageError for anything else.
Result<std::unique_ptr<eval::MeshSource>> open_any_meshes(const ClipArgument& argument,
                                                          const std::optional<CutOptions>& cut = {}, Index blend = 0);

// Meshes of one connectivity; of a stream, its finest level.
Result<std::unique_ptr<eval::MeshSource>> open_original(const ClipArgument& argument);

}  // namespace limber::tool
