// SPDX-License-Identifier: Apache-2.0
#include "eval/clip_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace limber::eval {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json one_way_json(const OneWayDistance& distance) {
  return {{"rms", distance.rms},
          {"mean", distance.mean},
          {"max", distance.max},
          {"rms_error", distance.rms_error},
          {"samples", distance.sample_count}};
}

Json frame_json(const FrameMeasure& frame) {
  const Distance& distance = frame.distance;
  const Quality& quality = frame.quality;
  return {{"frame", frame.number},
          {"triangles", quality.triangle_count},
          {"rms", distance.rms},
          {"mean", distance.mean},
          {"max", distance.max},
          {"flicker", number_or_null(frame.flicker)},
          {"changed", number_or_null(frame.changed)},
          {"rms_error", distance.rms_error},
          {"to_approximation", one_way_json(distance.to_approximation)},
          {"to_original", one_way_json(distance.to_original)},
          {"diagonal", distance.diagonal},
          {"inverted", quality.inverted},
          {"degenerate", quality.degenerate},
          {"least_angle", quality.least_angle},
          {"angle_percentile_5", quality.angle_percentile_5},
          {"mean_angle", quality.mean_angle}};
}

Json summary_json(const ClipSummary& summary, double Statistic::*which) {
  const auto pick = [&](const std::optional<Statistic>& s) { return s ? Json((*s).*which) : Json(nullptr); };
  return {{"rms", summary.rms.*which},
          {"mean", summary.mean.*which},
          {"max", summary.max.*which},
          {"flicker", pick(summary.flicker)},
          {"changed", pick(summary.changed)}};
}

const char* name_of(Sampling sampling) { return sampling == Sampling::kMetro ? "metro" : "area"; }

Json sampling_json(const ClipMeasure& measure) {
  const DistanceOptions& options = measure.options().distance;
  const Confidence confidence = measure.confidence();
  return {{"kind", name_of(options.sampling)},
          {"seed", options.samples.seed},
          {"original_samples", confidence.original_samples},
          {"approximation_samples", confidence.approximation_samples},
          {"rms_within_95", confidence.rms_within}};
}

// A column of the table is as wide as its heading here.
constexpr const char* kHeading = "  frame  triangles       rms      mean       max   flicker  changed  inverted\n";

struct Row {
  std::string name;
  double triangle_count, rms, mean, max;
  std::optional<double> flicker, changed;
  double inverted;
};

std::string line(const Row& row) {
  const std::string flicker = row.flicker ? fmt::format("{:.5f}", *row.flicker) : "-";
  const std::string changed = row.changed ? fmt::format("{:.2f} %", *row.changed * 100) : "-";
  return fmt::format("{:>7}  {:>9.0f}  {:>8.5f}  {:>8.5f}  {:>8.5f}  {:>8}  {:>7}  {:>8.5g}\n", row.name,
                     row.triangle_count, row.rms, row.mean, row.max, flicker, changed, row.inverted);
}

Row frame_row(const FrameMeasure& f) {
  return {fmt::format("{}", f.number),
          static_cast<double>(f.quality.triangle_count),
          f.distance.rms,
          f.distance.mean,
          f.distance.max,
          f.flicker,
          f.changed,
          static_cast<double>(f.quality.inverted)};
}

Row summary_row(std::string name, const ClipSummary& s, double Statistic::*which) {
  const auto pick = [&](const std::optional<Statistic>& statistic) {
    return statistic ? std::optional<double>((*statistic).*which) : std::nullopt;
  };
  return {std::move(name), s.triangle_count.*which, s.rms.*which,    s.mean.*which,
          s.max.*which,    pick(s.flicker),         pick(s.changed), s.inverted.*which};
}

}  // namespace

Json report_json(const ClipMeasure& measure) {
  const ClipSummary summary = measure.summary();
  Json report = {{"schema", "limber.measure/1"},
                 {"unit", "percent of the diagonal of the original's bounding box"},
                 {"frame_count", measure.frames().size()}};
  report.update(summary_json(summary, &Statistic::mean));
  report["percentile_95"] = summary_json(summary, &Statistic::percentile_95);
  report["worst"] = summary_json(summary, &Statistic::worst);
  report["sampling"] = sampling_json(measure);
  report["frames"] = Json::array();
  for (const FrameMeasure& frame : measure.frames()) report["frames"].push_back(frame_json(frame));
  return report;
}

std::string report_table(const ClipMeasure& measure) {
  std::string table = kHeading;
  for (const FrameMeasure& frame : measure.frames()) table += line(frame_row(frame));
  if (measure.frames().size() > 1) {
    const ClipSummary summary = measure.summary();
    table += line(summary_row("mean", summary, &Statistic::mean));
    table += line(summary_row("worst", summary, &Statistic::worst));
  }
  return table;
}

std::string sampling_line(const ClipMeasure& measure) {
  const DistanceOptions& options = measure.options().distance;
  const Confidence confidence = measure.confidence();
  return fmt::format(
      "{} samples on the original and {} on the approximation, {}, seed {}; rms to within {:.5f} with 95 % "
      "confidence\n",
      confidence.original_samples, confidence.approximation_samples,
      options.sampling == Sampling::kMetro ? "as Metro takes them" : "uniform by area", options.samples.seed,
      confidence.rms_within);
}

}  // namespace limber::eval
