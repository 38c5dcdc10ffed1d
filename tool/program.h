// SPDX-License-Identifier: Apache-2.0
// The program without its process: `limber ARGUMENTS...`.
#pragma once

#include <span>
#include <string>

#include "tool/console.h"
#include "tool/exit.h"

namespace limber::tool {

// Reads the arguments (without the program's name), does what they ask for, and says it on the console. Throws nothing.
Exit run_program(std::span<const std::string> arguments, Console& console);

}  // namespace limber::tool
