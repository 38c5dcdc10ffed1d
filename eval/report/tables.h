// SPDX-License-Identifier: Apache-2.0
// The tables of the report.
#pragma once

#include <string>

#include "eval/report/report.h"

namespace limber::eval {

// One sentence: who is nearest to the original, and who of those that keep their triangles.
std::string summary_sentence(const Comparison& comparison);

// A line per method; the best of each column stands out.
std::string summary_table(const Comparison& comparison);

std::string storage_table(const Report& report);

}  // namespace limber::eval
