// SPDX-License-Identifier: Apache-2.0
// The arguments by which verbs are told how a level of detail is looked at.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "limber/view/cut.h"
#include "limber/view/view.h"
#include "tool/console.h"

namespace limber::tool {

struct ViewArgument {
  std::optional<Vec3d> eye, target;
  Vec3d up{0, 1, 0};
  double fov_degrees = 24;
  int width = 1200, height = 900;
  std::optional<float> pixels;
  bool estimate = false;
  float silhouettes = 1, facing_away = 1;
  std::optional<Focus> focus;
  std::optional<Along> along;
  std::optional<double> curvature;  // degrees; of four-face files
};

// --eye, --target, --fov, --pixels, --estimate, --silhouettes, --facing-away, --focus and --along, in a group of their
// own. `argument` must outlive the parsing.
void declare_looking(CLI::App& app, ViewArgument& argument);

// --curvature.
void declare_curvature(CLI::App& app, ViewArgument& argument);

// --up and --size too, for verbs that have no pictures, whose options they are otherwise.
void declare_eye_picture(CLI::App& app, ViewArgument& argument);

// Nothing where none of them is given. Puts what --pixels says into the cut. Throws UsageError where something is
// missing: a target for the eye, an eye for the pixels, a size or an error for the view.
std::optional<View> view_of(const ViewArgument& argument, std::optional<CutOptions>& cut);

}  // namespace limber::tool
