// SPDX-License-Identifier: Apache-2.0
// What the report looks like: light, dark, on paper and on a telephone.
#pragma once

#include <string_view>

namespace limber::eval {

std::string_view report_style();

}  // namespace limber::eval
