// SPDX-License-Identifier: Apache-2.0
// The arguments by which all verbs take a part of a clip.
#pragma once

#include <CLI/CLI.hpp>

#include "limber/clip/clip.h"

namespace limber::tool {

// --frames, --first and --last. `options` must outlive the parsing.
void declare_frames(CLI::App& app, ClipOptions& options);

// Whether a part was asked for.
bool is_part(const ClipOptions& options);

// The same part of another clip.
void copy_part(const ClipOptions& from, ClipOptions& to);

}  // namespace limber::tool
