// SPDX-License-Identifier: Apache-2.0
// The arguments by which all verbs take a clip.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "limber/base/result.h"
#include "limber/clip/clip.h"

namespace limber::tool {

struct ClipArgument {
  std::string specification;
  ClipOptions options;
};

// CLIP, --mesh, --frames, --first and --last. `argument` must outlive the parsing.
void declare_clip(CLI::App& app, ClipArgument& argument, const std::string& name = "CLIP");

// Whatever open_clip() opens, and streams: `FILE.limber`, or `-` for one on standard input.
Result<std::unique_ptr<ClipReader>> open_any_clip(const ClipArgument& argument);

}  // namespace limber::tool
