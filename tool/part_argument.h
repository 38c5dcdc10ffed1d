// SPDX-License-Identifier: Apache-2.0
// --part: a named ball around a part of the surface.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "eval/report/parts.h"

namespace limber::tool {

// `texts` must outlive the parsing.
void declare_part(CLI::App& app, std::vector<std::string>& texts);

// Throws UsageError.
std::vector<eval::PartBall> wanted_parts(const std::vector<std::string>& texts);

}  // namespace limber::tool
