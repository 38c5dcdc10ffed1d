// SPDX-License-Identifier: Apache-2.0
// The charts of a report, filled in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/report/charts.h"
#include "eval/report/report.h"

namespace limber::eval {

// RMS distance per frame.
FrameChart rms_chart(const Report& report);

// The same, cut off at half as much again as the first method's largest; nothing where that shows no more.
std::optional<FrameChart> near_rms_chart(const Report& report);

// Processor time to adapt each frame.
FrameChart adapt_chart(const Report& report);

// RMS against changed triangles.
TradeOff trade_off_chart(const Report& report);

// How the distances are spread, a histogram per method.
std::vector<Histogram> distance_histograms(const Report& report);

}  // namespace limber::eval
