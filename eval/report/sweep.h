// SPDX-License-Identifier: Apache-2.0
// One parameter of a method tried at several values, with all else as it is.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/comparison.h"
#include "eval/report/charts.h"

namespace limber::eval {

// What the method made of the clip with one value. Distances are in percent of the diagonal, means over the frames.
struct SweepPoint {
  double value = 0;
  double rms = 0, rms_worst = 0, max = 0;  // worst: of all frames
  double relative = 1;                     // mean over the frames of rms over that of the report's first method
  double quadric_error = 0;
  std::optional<double> flicker{}, changed{};  // as ClipSummary
  std::optional<double> choice_bytes{};        // per frame, for connectivity alone; nothing where it is not known
  double adapt_ms = 0, begin_seconds = 0;
};

struct Sweep {
  std::string parameter{};  // as the program calls it
  const MethodInfo* method = nullptr;
  MethodMark mark{};
  double used = 0;                   // the value of the rest of the report
  std::vector<SweepPoint> points{};  // by rising value
};

// `tried`: a comparison of the method alone, with this value, on the same frames. `report`: the first of its methods is
// what the others are held against.
SweepPoint sweep_point(double value, const Comparison& tried, const Comparison& report);

// RMS, changed triangles and, where they are known, the bytes of the choices: each over the values.
std::vector<SweepChart> sweep_charts(const Sweep& sweep, const std::string& first_method);

// A section of the page. Precondition: there is a sweep. `figure_number`: of the first of them.
std::string sweep_section(const std::vector<Sweep>& sweeps, const std::string& first_method, int figure_number);

nlohmann::ordered_json sweeps_json(const std::vector<Sweep>& sweeps);

}  // namespace limber::eval
