// SPDX-License-Identifier: Apache-2.0
#include "tool/method_argument.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "eval/peers/peers.h"
#include "tool/exit.h"
#include "tool/recluster_argument.h"
#include "tool/suggest.h"

namespace limber::tool {
namespace {

std::string list_methods() {
  std::string text;
  for (const eval::MethodInfo& info : eval::methods())
    text += fmt::format("; {}{}: {}", info.peer ? "peer " : "", info.name, info.description);
  return text;
}

void declare_size(CLI::App& app, MethodArgument& argument) {
  app.add_option("--vertices", argument.vertices, "at most N vertices")->type_name("N");
  app.add_option("--triangles", argument.triangles, "at most N triangles")->type_name("N");
  app.add_option("--ratio", argument.ratio, "the share of the vertices that is kept, as in 0.1")->type_name("SHARE");
}

void declare_feature(CLI::App& app, eval::FeatureOptions& options) {
  const std::string group = "FEATURE";
  app.add_option("--k1", options.deformation, "how much edges are spared whose cost changes over the frames")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str()
      ->group(group);
  app.add_option("--k2", options.feature, "how much border, sharp and complex edges are spared")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str()
      ->group(group);
  app.add_option("--sharp-angle", options.sharp_angle, "an edge is sharp below so many degrees between its triangles")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str()
      ->group(group);
  app.add_option("--unified", options.unified_share, "the share of the contractions that all frames have in common")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str()
      ->group(group);
  app.add_flag("--literal", options.literal, "the formulas as the paper prints them")->group(group);
  app.add_flag("--memory,!--no-memory", options.memory, "a frame prefers the contractions of the one before (default)")
      ->group(group);
}

void check_placement(const MethodArgument& argument, std::span<const eval::MethodInfo* const> chosen) {
  if (argument.options.contract.placement == Placement::kQuadric) return;
  for (const eval::MethodInfo* info : chosen) {
    if (info->name == "direct" || info->name == "direct-volume") continue;
    throw UsageError(
        fmt::format("--placement volume is for --method direct: it simplifies one frame by itself, and {} "
                    "needs the quadrics of many",
                    info->name));
  }
}

void check_size(const MethodArgument& argument) {
  switch (argument.vertices.has_value() + argument.triangles.has_value() + argument.ratio.has_value()) {
    case 0:
      throw UsageError("how small? give --vertices, --triangles or --ratio");
    case 1:
      break;
    default:
      throw UsageError("--vertices, --triangles and --ratio exclude each other");
  }
  if (argument.vertices == 0u || argument.triangles == 0u) throw UsageError("nothing would be left; ask for more");
  if (argument.ratio && !(*argument.ratio > 0 && *argument.ratio <= 1))
    throw UsageError("--ratio is the share that is kept, more than 0 and at most 1");
}

}  // namespace

void declare_method(CLI::App& app, MethodArgument& argument) {
  app.add_option("--method", argument.names, "one, or several with commas" + list_methods())
      ->type_name("M")
      ->delimiter(',')
      ->required();
  declare_size(app, argument);
  eval::MethodOptions& options = argument.options;
  app.add_option_function<std::string>(
         "--topology",
         [&options](const std::string& name) {
           options.contract.topology = name == "free" ? Topology::kFree : Topology::kPreserve;
         },
         "preserve, or free: holes may close and necks collapse")
      ->type_name("KIND")
      ->check(CLI::IsMember(std::vector<std::string>{"preserve", "free"}))
      ->default_str("preserve");
  app.add_option_function<std::string>(
         "--placement",
         [&options](const std::string& name) {
           options.contract.placement = name == "volume" ? Placement::kVolume : Placement::kQuadric;
         },
         "of direct: quadric, or volume: closer, in two to three times the time (as method direct-volume)")
      ->type_name("KIND")
      ->check(CLI::IsMember(std::vector<std::string>{"quadric", "volume"}))
      ->default_str("quadric");
  const std::string group = "MULTILEVEL";
  app.add_option("--branching", options.branching, "how many times smaller each level is than the one below")
      ->check(CLI::Range(1.1, 1e6))
      ->capture_default_str()
      ->group(group);
  app.add_option("--levels", options.level_sizes, "exact sizes of the levels above the finest, as in 3200,800")
      ->type_name("N,...")
      ->delimiter(',')
      ->group(group);
  app.add_option("--base-frames", argument.base_frames, "frames that the base hierarchy is made for")
      ->type_name("N")
      ->check(CLI::Range(1u, 1000u))
      ->capture_default_str()
      ->group(group);
  declare_recluster(app, options.recluster, group);
  app.add_option("--blend", options.blend,
                 "blend each change between frames over so many frames, with more vertices meanwhile; 0: not at all")
      ->type_name("N")
      ->check(CLI::Range(0u, 1000u))
      ->capture_default_str()
      ->group(group);
  declare_feature(app, options.feature);
  app.add_option("--history", options.history,
                 "what a contraction costs of its price that leads to a node of the frame before; 1: no history")
      ->type_name("SHARE")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str()
      ->group("T-DAG");
}

std::vector<const eval::MethodInfo*> chosen_methods(const MethodArgument& argument) {
  std::vector<const eval::MethodInfo*> chosen;
  for (const std::string& name : argument.names) {
    const eval::MethodInfo* const info = eval::find_method(name);
    if (info == nullptr && !eval::package_of_peer(name).empty())
      throw UsageError(
          fmt::format("this program was built without {}, which method {} needs", eval::package_of_peer(name), name));
    if (info == nullptr) {
      std::vector<std::string> names;
      for (const eval::MethodInfo& known : eval::methods()) names.emplace_back(known.name);
      const std::string meant = nearest(name, names);
      throw UsageError(fmt::format("there is no method \"{}\"; {}the methods are {}", name,
                                   meant.empty() ? "" : fmt::format("did you mean \"{}\"? ", meant),
                                   fmt::join(names, ", ")));
    }
    if (std::ranges::find(chosen, info) != chosen.end())
      throw UsageError(fmt::format("method {} is given twice", name));
    chosen.push_back(info);
  }
  const std::vector<Index>& sizes = argument.options.level_sizes;
  if (std::ranges::find(sizes, 0u) != sizes.end()) throw UsageError("--levels have at least one vertex each");
  if (std::ranges::adjacent_find(sizes, std::ranges::less_equal{}) != sizes.end())
    throw UsageError("--levels go from fine to coarse: each must be smaller than the one before");
  check_placement(argument, chosen);
  check_size(argument);
  return chosen;
}

Error unsupported(const std::string& clip, const eval::MethodInfo& info, const Error& why) {
  return {why.code, clip, fmt::format("{} cannot take this clip: {}", info.name, why.line())};
}

eval::MethodOptions method_options(const MethodArgument& argument, const Mesh& mesh) {
  eval::MethodOptions options = argument.options;
  options.vertices = argument.vertices.value_or(0);
  options.triangles = argument.triangles.value_or(0);
  if (argument.ratio) {
    std::vector<bool> used(mesh.vertex_count, false);
    for (const Triangle& triangle : mesh.triangles) {
      for (const Index vertex : triangle) used[vertex] = true;
    }
    const auto count = static_cast<double>(std::ranges::count(used, true));
    options.vertices = std::max(Index{1}, static_cast<Index>(std::lround(count * *argument.ratio)));
  }
  return options;
}

}  // namespace limber::tool
