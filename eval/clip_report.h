// SPDX-License-Identifier: Apache-2.0
// What was measured, for programs and for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "eval/clip_measure.h"

namespace limber::eval {

// Schema "limber.measure/1". On top, for the whole clip: `rms`, `mean`, `max`, `flicker`, `changed`, means over the
// frames; `worst` and `percentile_95` hold the same five. `frames` holds every frame: these five (`flicker` there is
// the change since the frame before), both directions of the distance, and the quality of the triangles. `sampling`
// says how the distances were sampled, and how sure they are of `rms` (see Confidence). Distances
// and flicker are percentages of the diagonal of the original's bounding box, `changed` a share between 0 and 1.
// What a clip or frame does not have is null. Keys may be added; none changes its meaning without a new schema number.
nlohmann::ordered_json report_json(const ClipMeasure& measure);

// A table in plain text: a line per frame, then their mean and the worst. One frame: that line only.
std::string report_table(const ClipMeasure& measure);

// How the distances were sampled, and what that makes of `rms`: one line.
std::string sampling_line(const ClipMeasure& measure);

}  // namespace limber::eval
