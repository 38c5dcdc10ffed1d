// SPDX-License-Identifier: Apache-2.0
#include "tool/level_argument.h"

#include "tool/exit.h"

namespace limber::tool {

void declare_level(CLI::App& app, LevelArgument& argument) {
  app.add_option("--vertices", argument.vertices, "at most N vertices, with the least error that they allow")
      ->type_name("N");
  app.add_option("--triangles", argument.triangles, "at most N triangles, with the least error that they allow")
      ->type_name("N");
  app.add_option("--level", argument.level, "a level of the hierarchy; 0 is the input")->type_name("K");
  app.add_option("--error", argument.error, "as coarse as this error allows, in percent of the diagonal")
      ->type_name("PCT");
  app.add_option("--hysteresis", argument.hysteresis,
                 "how many times better, in squared error, a change between frames must be; 1 makes every frame by "
                 "itself (1.6 for several frames, 1 for one)")
      ->type_name("H");
  app.add_option("--blend", argument.blend,
                 "blend each change between frames over so many frames, with more vertices meanwhile; 0: not at all")
      ->type_name("N")
      ->check(CLI::Range(0u, 1000u))
      ->capture_default_str();
}

std::optional<CutOptions> cut_options(const LevelArgument& argument, bool single_frame) {
  const int given = argument.vertices.has_value() + argument.triangles.has_value() + argument.level.has_value() +
                    argument.error.has_value();
  if (given > 1) throw UsageError("--vertices, --triangles, --level and --error exclude each other");
  if (argument.vertices == 0u || argument.triangles == 0u)
    throw UsageError("a level of detail has at least one vertex and one triangle");
  if (argument.error && !(*argument.error >= 0)) throw UsageError("--error must not be negative");
  if (argument.hysteresis && !(*argument.hysteresis >= 1)) throw UsageError("--hysteresis must be at least 1");
  CutOptions cut;
  cut.hysteresis = argument.hysteresis.value_or(single_frame ? 1.0f : cut.hysteresis);
  if (argument.vertices) {
    cut.by = CutBy::kVertices;
    cut.budget = *argument.vertices;
  } else if (argument.triangles) {
    cut.by = CutBy::kTriangles;
    cut.budget = *argument.triangles;
  } else if (argument.level) {
    cut.by = CutBy::kLevel;
    cut.level = *argument.level;
  } else if (argument.error) {
    cut.by = CutBy::kError;
    cut.error_bound = *argument.error;
  } else {
    return std::nullopt;
  }
  return cut;
}

std::string describe(const std::optional<CutOptions>& cut, const std::optional<View>& view) {
  if (!cut) return "the finest level";
  const auto unless_below = [&] {
    return cut->enough > 0 ? fmt::format(", no finer than {} pixels", cut->enough) : std::string();
  };
  switch (cut->by) {
    case CutBy::kVertices:
      return fmt::format("at most {} vertices{}", cut->budget, unless_below());
    case CutBy::kTriangles:
      return fmt::format("at most {} triangles{}", cut->budget, unless_below());
    case CutBy::kError:
      return fmt::format("an error of at most {} {}", cut->error_bound, view && view->camera ? "pixels" : "%");
    case CutBy::kLevel:
      break;
  }
  return fmt::format("level {}", cut->level);
}

Json describe_json(const std::optional<CutOptions>& cut, const std::optional<View>& view) {
  if (!cut) return {{"level", 0}};
  Json json;
  switch (cut->by) {
    case CutBy::kVertices:
      json = {{"vertices", cut->budget}};
      break;
    case CutBy::kTriangles:
      json = {{"triangles", cut->budget}};
      break;
    case CutBy::kError:
      json = {{view && view->camera ? "pixels" : "error", cut->error_bound}};
      break;
    case CutBy::kLevel:
      json = {{"level", cut->level}};
      break;
  }
  if (cut->enough > 0) json["pixels"] = cut->enough;
  return json;
}

}  // namespace limber::tool
