// SPDX-License-Identifier: Apache-2.0
// The sub-commands. Each has a file of its own, with a function that declares its arguments and gives what is to be
// done when they have been read.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <span>
#include <string_view>

#include "limber/base/result.h"
#include "tool/console.h"
#include "tool/exit.h"

namespace limber::tool {

// What a verb does. It gives kDone, or kCheckFailed where it has said what is wrong; all else is an error.
// May throw UsageError before it does anything.
using Action = std::function<Result<Exit>(Console&)>;

struct Verb {
  std::string_view name;
  std::string_view summary;   // one line, for the list of verbs and the top of its help
  std::string_view examples;  // whole lines that a user can type
  Action (*declare)(CLI::App& app);
};

// In the order in which the help lists them.
std::span<const Verb> verbs();

Action declare_build(CLI::App& app);
Action declare_check(CLI::App& app);
Action declare_compare(CLI::App& app);
Action declare_convert(CLI::App& app);
Action declare_extract(CLI::App& app);
Action declare_info(CLI::App& app);
Action declare_measure(CLI::App& app);
Action declare_play(CLI::App& app);
Action declare_render(CLI::App& app);
Action declare_sample(CLI::App& app);
Action declare_simplify(CLI::App& app);
Action declare_view(CLI::App& app);

}  // namespace limber::tool
