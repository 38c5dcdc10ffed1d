// SPDX-License-Identifier: Apache-2.0
// A comparison as a page to look at, and the same for programs: `limber compare`.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/comparison.h"
#include "eval/report/parts.h"
#include "eval/report/pictures.h"
#include "eval/report/storage.h"
#include "eval/report/sweep.h"
#include "eval/report/worst_places.h"

namespace limber::eval {

struct ClipFacts {
  std::string name{};  // as it was asked for
  Index vertex_count = 0;
  std::size_t triangle_count = 0;
  std::uint32_t first_frame = 0;
  double frames_per_second = 24;
};

// A method that the clip cannot be given to.
struct LeftOut {
  std::string method{};
  std::string why{};
};

// What somebody needs to make the report again.
struct RunFacts {
  std::string asked{};                  // "at most 800 vertices"
  std::vector<std::string> commands{};  // the first is the one that made the report
  std::string version{};                // of limber
  std::string compiler{}, processor{};
  unsigned threads = 1;
  std::string date{};
  DistanceOptions distance{};
  std::vector<LeftOut> left_out{};
};

// Refers to what has been measured.
struct Report {
  const Comparison& comparison;  // the first contender is what the others are held against; a frame has been added
  const WorstPlaces& places;     // of the same methods and frames
  ClipFacts clip{};
  RunFacts run{};
  std::vector<StorageRow> storage{};
  std::optional<BuildReport> stream{};
  PictureSet pictures{};
  const Parts* parts = nullptr;  // of the same methods and frames; may be nothing, as may be the sweeps
  std::vector<Sweep> sweeps{};
};

// Where the colours and histograms of a report shall end, in percent of the diagonal: a round number that 99 of 100
// distances of the method in the middle do not exceed.
double report_error_range(const WorstPlaces& places, std::size_t method_count);

// One page of HTML that needs nothing else: style, drawings and pictures are in it.
std::string report_page(const Report& report);

// Schema "limber.compare/1", without the pictures: `clip`, `run`, `storage`, `gallery` (frame numbers), `close_ups`,
// `parts`, `sweeps`, and the rest of "limber.simplify/1", each method with the `distribution` of its distances.
nlohmann::ordered_json report_json(const Report& report);

// A line per method and frame under a line of headings; no value: nothing between the commas.
std::string report_csv(const Comparison& comparison);

// A file of its own.
struct ReportFigure {
  std::string name{};  // of the file
  std::string bytes{};
};

// What the page shows, for other documents: charts as SVG (rms, trade-off, adapt-time, histograms, sweep-NAME) and rows
// of pictures as PNG (frame-NUMBER, part-NAME, worst-NUMBER), the latter where sheets have been asked for.
std::vector<ReportFigure> report_figures(const Report& report);

}  // namespace limber::eval
