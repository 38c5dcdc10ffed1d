// SPDX-License-Identifier: Apache-2.0
// The arguments by which verbs are told a level of detail.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "limber/view/cut.h"
#include "limber/view/view.h"
#include "tool/console.h"

namespace limber::tool {

struct LevelArgument {
  std::optional<Index> vertices;
  std::optional<Index> triangles;
  std::optional<Index> level;
  std::optional<float> error;
  std::optional<float> hysteresis;
  Index blend = 0;
};

// --vertices, --triangles, --level, --error, --hysteresis and --blend. `argument` must outlive the
// parsing.
void declare_level(CLI::App& app, LevelArgument& argument);

// Nothing where no level is asked for. Throws UsageError for more than one, and for values out of range. A single frame
// has no hysteresis unless it is asked for.
std::optional<CutOptions> cut_options(const LevelArgument& argument, bool single_frame);

// "at most 800 vertices"; and the same for machines. With a camera errors are in pixels.
std::string describe(const std::optional<CutOptions>& cut, const std::optional<View>& view = {});
Json describe_json(const std::optional<CutOptions>& cut, const std::optional<View>& view = {});

}  // namespace limber::tool
