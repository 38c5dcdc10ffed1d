// SPDX-License-Identifier: Apache-2.0
// The arguments by which all verbs take an output.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace limber::tool {

struct OutputArgument {
  std::string path;
  bool replace = false;

  bool is_standard_output() const { return path == "-"; }
};

// -o and -f. `argument` must outlive the parsing.
void declare_output(CLI::App& app, OutputArgument& argument, const std::string& description, bool required = true);

}  // namespace limber::tool
