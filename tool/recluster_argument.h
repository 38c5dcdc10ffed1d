// SPDX-License-Identifier: Apache-2.0
// How a hierarchy follows a clip, as arguments of build and of the methods.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "limber/hierarchy/recluster.h"

namespace limber::tool {

// --follow and the numbers behind it, which change single ones of those that --follow stands for, wherever they are
// given. `options` must outlive the parsing.
void declare_recluster(CLI::App& app, ReclusterOptions& options, const std::string& group);

}  // namespace limber::tool
