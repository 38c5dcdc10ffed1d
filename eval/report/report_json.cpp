// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "eval/report/report.h"

namespace limber::eval {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kSteps = 50;

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json distribution_json(const ErrorDistribution& distribution, double range) {
  return {{"step", range / kSteps},
          {"shares", distribution.shares(range, kSteps)},  // the last: all beyond
          {"median", distribution.percentile(0.5)},
          {"percentile_95", distribution.percentile(0.95)},
          {"samples", distribution.size()}};
}

Json run_json(const RunFacts& run) {
  Json left_out = Json::array();
  for (const LeftOut& method : run.left_out) left_out.push_back({{"method", method.method}, {"why", method.why}});
  return {{"commands", run.commands},
          {"left_out", left_out},
          {"version", run.version},
          {"compiler", run.compiler},
          {"processor", run.processor},
          {"threads", run.threads},
          {"date", run.date},
          {"sampling", run.distance.sampling == Sampling::kMetro ? "metro" : "area"},
          {"seed", run.distance.samples.seed}};
}

Json storage_json(const Report& report) {
  Json rows = Json::array();
  for (const StorageRow& row : report.storage) {
    rows.push_back({{"what", row.what},
                    {"how", row.how},
                    {"connectivity_bytes_per_frame", number_or_null(row.connectivity)},
                    {"position_bytes_per_frame", number_or_null(row.positions)},
                    {"bytes", row.total}});
  }
  return rows;
}

Json close_ups_json(const Report& report) {
  Json close_ups = Json::array();
  for (const CloseUp& close_up : report.pictures.close_ups) {
    const WorstPlace& place = close_up.place;
    close_ups.push_back({{"method", report.comparison.contenders()[close_up.method].info->name},
                         {"frame", report.clip.first_frame + place.frame},
                         {"point", {place.point.x, place.point.y, place.point.z}},
                         {"rms", place.rms}});
  }
  return close_ups;
}

Json parts_json(const Report& report) {
  Json parts = Json::array();
  for (std::size_t part = 0; report.parts != nullptr && part < report.parts->size(); ++part) {
    const PartBall& ball = report.parts->ball(part);
    Json methods = Json::array();
    for (std::size_t m = 0; m < report.comparison.contenders().size(); ++m) {
      const PartMeasure measure = report.parts->measure(part, m);
      methods.push_back({{"method", report.comparison.contenders()[m].info->name},
                         {"triangles", measure.triangles},
                         {"triangles_last_frame", measure.last_triangles},
                         {"rms", measure.rms}});
    }
    parts.push_back({{"name", ball.name},
                     {"center", {ball.center.x, ball.center.y, ball.center.z}},
                     {"radius", ball.radius},
                     {"original_triangles", report.parts->triangles(part).size()},
                     {"methods", methods}});
  }
  return parts;
}

}  // namespace

double report_error_range(const WorstPlaces& places, std::size_t method_count) {
  std::vector<double> ends;
  for (std::size_t m = 0; m < method_count; ++m) ends.push_back(places.distribution(m).percentile(0.99));
  const auto middle = ends.begin() + static_cast<std::ptrdiff_t>((ends.size() - 1) / 2);
  std::nth_element(ends.begin(), middle, ends.end());
  if (!(*middle > 1e-6)) return 1e-4;
  const double decade = std::pow(10.0, std::floor(std::log10(*middle)));
  for (const double step : {1.0, 1.2, 1.6, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    if (decade * step >= *middle) return decade * step;
  }
  return decade * 10;
}

Json report_json(const Report& report) {
  const ClipFacts& clip = report.clip;
  Json gallery = Json::array();
  for (const PictureRow& row : report.pictures.gallery) gallery.push_back(clip.first_frame + row.frame);
  Json json = {{"schema", "limber.compare/1"},
               {"clip",
                {{"name", clip.name},
                 {"vertices", clip.vertex_count},
                 {"triangles", clip.triangle_count},
                 {"frames", report.comparison.contenders().front().frames.size()},
                 {"first_frame", clip.first_frame},
                 {"frames_per_second", clip.frames_per_second}}},
               {"run", run_json(report.run)},
               {"storage", storage_json(report)},
               {"gallery", gallery},
               {"close_ups", close_ups_json(report)},
               {"parts", parts_json(report)},
               {"sweeps", sweeps_json(report.sweeps)},
               {"error_range", report.pictures.error_range}};
  Json compared = comparison_json(report.comparison);
  compared.erase("schema");
  for (std::size_t m = 0; m < compared["methods"].size(); ++m)
    compared["methods"][m]["distribution"] =
        distribution_json(report.places.distribution(m), report.pictures.error_range);
  json.update(compared);
  return json;
}

std::string report_csv(const Comparison& comparison) {
  std::string csv =
      "frame,method,vertices,triangles,rms,mean,max,rms_error,flicker,changed,quadric_error,inverted,degenerate,"
      "least_angle,angle_percentile_5,mean_angle,adapt_ms,list_ms\n";
  const auto or_nothing = [](const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; };
  for (std::size_t t = 0; t < comparison.contenders().front().frames.size(); ++t) {
    for (const Contender& contender : comparison.contenders()) {
      const FrameMeasure& measured = contender.measure.frames()[t];
      const MethodFrame& made = contender.frames[t];
      const Distance& distance = measured.distance;
      const Quality& quality = measured.quality;
      csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", measured.number,
                         contender.info->name, made.vertex_count, quality.triangle_count, distance.rms, distance.mean,
                         distance.max, distance.rms_error, or_nothing(measured.flicker), or_nothing(measured.changed),
                         or_nothing(made.quadric_error), quality.inverted, quality.degenerate, quality.least_angle,
                         quality.angle_percentile_5, quality.mean_angle, 1000 * made.adapt_seconds,
                         1000 * made.extract_seconds);
    }
  }
  return csv;
}

}  // namespace limber::eval
