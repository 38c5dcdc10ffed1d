// SPDX-License-Identifier: Apache-2.0
// Numbers between commas.
#pragma once

#include <span>
#include <string_view>

namespace limber::tool {

// Whether the text is as many finite numbers as there is room for, with commas between them, as in 1,-2.5,3e-2.
bool parse_numbers(std::string_view text, std::span<double> numbers);

}  // namespace limber::tool
