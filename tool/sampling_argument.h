// SPDX-License-Identifier: Apache-2.0
// The arguments by which verbs are told how to measure distances.
#pragma once

#include <CLI/CLI.hpp>

#include "eval/distance.h"

namespace limber::tool {

// --sampling, --samples and --seed. `options` must outlive the parsing.
void declare_sampling(CLI::App& app, eval::DistanceOptions& options);

}  // namespace limber::tool
