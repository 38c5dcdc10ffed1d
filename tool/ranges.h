// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace limber::tool {

// Numbers from low to high, both included. Unlike CLI::Range it refuses nan and leaves the help line short.
CLI::Validator in_range(double low, double high);

// Numbers above 0, up to high.
CLI::Validator above_zero(double high);

}  // namespace limber::tool
