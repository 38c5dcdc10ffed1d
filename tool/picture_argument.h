// SPDX-License-Identifier: Apache-2.0
// The arguments by which verbs are told what a picture shall look like.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "eval/picture.h"
#include "tool/clip_argument.h"
#include "tool/view_argument.h"

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
  bool given = false;       // any of them
  bool view_given = false;  // --view
};

// Does the name end as that of a picture?
bool is_picture(std::string_view path);

// "1200x900": two numbers from 1 to 16384.
bool parse_size(std::string_view text, int& width, int& height);

// --view and --up, which the next has too. `argument` must outlive the parsing of both.
void declare_view(CLI::App& app, PictureArgument& argument);

// --wireframe, --flat, --error-colors and so on, in a group of their own.
void declare_picture(CLI::App& app, PictureArgument& argument);

// The size and the axis that points up are those of the picture.
ViewArgument with_picture(ViewArgument view, const PictureArgument& picture);

// Pictures are taken from the eye, unless --view says otherwise.
std::optional<Camera> camera_of(const std::optional<View>& view, const PictureArgument& picture);

}  // namespace limber::tool
