// SPDX-License-Identifier: Apache-2.0
// Where and when a figure was measured.
#pragma once

#include <string>

namespace limber::tool {

std::string processor_name();

std::string compiler_name();

// "2026-11-22", in Greenwich.
std::string today();

}  // namespace limber::tool
