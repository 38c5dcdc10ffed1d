// SPDX-License-Identifier: Apache-2.0
// The arguments by which verbs are told what a picture shall look like.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "eval/picture.h"
#include "tool/clip_argument.h"

namespace limber::tool {

enum class Fit {
  kSuitable,  // the clip where several frames are shown, and else the frame
  kClip,
  kFrame,
};

struct PictureArgument {
  eval::PictureOptions options;
  ClipArgument original;  // empty: see the verb
  Fit fit = Fit::kSuitable;
  bool given = false;  // any of them
};

// Does the name end as that of a picture?
bool is_picture(std::string_view path);

// --view and --up, which the next has too. `argument` must outlive the parsing of both.
void declare_view(CLI::App& app, PictureArgument& argument);

// --wireframe, --flat, --error-colors and so on, in a group of their own.
void declare_picture(CLI::App& app, PictureArgument& argument);

}  // namespace limber::tool
