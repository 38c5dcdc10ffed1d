// SPDX-License-Identifier: Apache-2.0
// The arguments by which verbs are told methods of simplification and their settings.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "eval/methods/method.h"

namespace limber::tool {

struct MethodArgument {
  std::vector<std::string> names;
  std::optional<Index> vertices;
  std::optional<Index> triangles;
  std::optional<double> ratio;
  eval::MethodOptions options;  // without the size
  std::uint32_t base_frames = 8;
};

// --method, the size, and the options of `limber build` that concern methods. `argument` must outlive the parsing.
void declare_method(CLI::App& app, MethodArgument& argument);

// Throws UsageError for a name that no method has, for one that is given twice, and for none.
std::vector<const eval::MethodInfo*> chosen_methods(const MethodArgument& argument);

// What MethodInfo::supports() said, as an error about the clip.
Error unsupported(const std::string& clip, const eval::MethodInfo& info, const Error& why);

// With the size for this mesh, of which a ratio is taken without its isolated vertices. Throws UsageError for no size.
eval::MethodOptions method_options(const MethodArgument& argument, const Mesh& mesh);

}  // namespace limber::tool
