// SPDX-License-Identifier: Apache-2.0
// The arguments by which verbs are told from where something is seen, and where it is looked at.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "limber/fourface/front_request.h"

namespace limber::tool {

struct ViewArgument {
  std::vector<double> eye, target, focus;
  double fov_degrees = 50;
  std::optional<double> pixels;
  std::optional<double> curvature;

  bool is_given() const { return !eye.empty() || !target.empty() || !focus.empty() || pixels || curvature; }
};

// --eye, --target, --fov, --pixels, --focus and --curvature. `argument` must outlive the parsing.
void declare_viewpoint(CLI::App& app, ViewArgument& argument);

// The parts of the request that the arguments name, for a picture of this size. Throws UsageError where they do not fit
// together.
FrontRequest view_request(const ViewArgument& argument, int width, int height);

}  // namespace limber::tool
