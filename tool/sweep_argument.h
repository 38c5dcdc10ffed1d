// SPDX-License-Identifier: Apache-2.0
// --sweep: one parameter of a method at several values.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "eval/methods/method.h"

namespace limber::tool {

struct WantedSweep {
  std::string parameter;  // an option of declare_method(), without the dashes
  const eval::MethodInfo* method = nullptr;
  double& (*value)(eval::MethodOptions&) = nullptr;
  std::vector<double> values;  // at least two, rising
};

// `texts` must outlive the parsing.
void declare_sweep(CLI::App& app, std::vector<std::string>& texts);

// Values obey the rules of the options that the parameters are called after, which `app` has. Throws UsageError.
std::vector<WantedSweep> wanted_sweeps(const std::vector<std::string>& texts, CLI::App& app);

}  // namespace limber::tool
