// SPDX-License-Identifier: Apache-2.0
// What the report looks like: light, dark, on paper and on a telephone.
#pragma once

#include <string>
#include <string_view>

namespace limber::eval {

std::string report_style();

// A drawing as a file of its own, in the same colours on a ground of its own. It starts with what open_svg() gives.
std::string standalone(std::string_view drawing);

}  // namespace limber::eval
