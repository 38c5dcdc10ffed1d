// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "eval/clip_report.h"
#include "eval/comparison.h"

namespace limber::eval {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Statistic over_frames(const Contender& contender, const Value& value) {
  std::vector<double> values;
  for (const MethodFrame& frame : contender.frames) values.push_back(value(frame));
  return statistic(std::move(values)).value_or(Statistic{});
}

Statistic milliseconds(const Contender& contender, double MethodFrame::*seconds) {
  return over_frames(contender, [=](const MethodFrame& frame) { return 1000 * frame.*seconds; });
}

Statistic vertex_counts(const Contender& contender) {
  return over_frames(contender, [](const MethodFrame& frame) { return static_cast<double>(frame.vertex_count); });
}

Json statistic_json(const Statistic& s) {
  return {{"mean", s.mean}, {"percentile_95", s.percentile_95}, {"worst", s.worst}};
}

Json statistic_json(const std::optional<Statistic>& s) { return s ? statistic_json(*s) : Json(nullptr); }

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json relative_json(const Comparison& comparison, std::size_t i) {
  const Relative relative = comparison.relative(i);
  return {{"to", comparison.contenders().front().info->name},
          {"rms", relative.rms_by_frame},
          {"rms_of_means", relative.rms_by_mean},
          {"rms_worst_frame", relative.rms_worst},
          {"quadric_error", number_or_null(relative.quadric_error)},
          {"adapt_time", relative.adapt_time}};
}

Json contender_json(const Comparison& comparison, std::size_t i) {
  const Contender& contender = comparison.contenders()[i];
  Json json = {{"method", contender.info->name},
               {"vertices", statistic_json(vertex_counts(contender))},
               {"quadric_error", statistic_json(quadric_errors(contender))},
               {"begin_ms", 1000 * contender.begin_seconds},
               {"adapt_ms", statistic_json(milliseconds(contender, &MethodFrame::adapt_seconds))},
               {"extract_ms", statistic_json(milliseconds(contender, &MethodFrame::extract_seconds))},
               {"relative", relative_json(comparison, i)}};
  Json measured = report_json(contender.measure);
  for (std::size_t t = 0; t < contender.frames.size(); ++t) {
    const MethodFrame& frame = contender.frames[t];
    measured["frames"][t].update(Json{{"vertices", frame.vertex_count},
                                      {"quadric_error", number_or_null(frame.quadric_error)},
                                      {"adapt_ms", 1000 * frame.adapt_seconds},
                                      {"extract_ms", 1000 * frame.extract_seconds}});
  }
  for (const char* const key : {"schema", "unit", "frame_count"}) measured.erase(key);
  json.update(measured);
  return json;
}

std::string or_dash(const std::optional<Statistic>& s, double scale, const char* unit, int digits) {
  return s ? fmt::format("{:.{}f}{}", s->mean * scale, digits, unit) : "-";
}

}  // namespace

Json comparison_json(const Comparison& comparison) {
  Json json = {{"schema", "limber.simplify/1"},
               {"unit", "percent of the diagonal of the original's bounding box"},
               {"quadric_error_unit", "fourth power of that diagonal"},
               {"frame_count", comparison.contenders().front().frames.size()}};
  json["methods"] = Json::array();
  for (std::size_t i = 0; i < comparison.contenders().size(); ++i) {
    json["methods"].push_back(contender_json(comparison, i));
  }
  return json;
}

std::string comparison_table(const Comparison& comparison) {
  const std::span<const Contender> contenders = comparison.contenders();
  std::size_t width = 12;
  for (const Contender& contender : contenders) width = std::max(width, contender.info->name.size());
  std::string table = fmt::format("{:<{}}  {:>8}  {:>9}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>9}  {:>9}  {:>9}\n",
                                  "method", width, "vertices", "triangles", "rms %", "mean %", "max %", "flicker",
                                  "changed", "QEM", "adapt ms", "list ms");
  for (const Contender& contender : contenders) {
    const ClipSummary summary = contender.measure.summary();
    const std::optional<Statistic> quadric_error = quadric_errors(contender);
    table += fmt::format(
        "{:<{}}  {:>8.0f}  {:>9.0f}  {:>8.5f}  {:>8.5f}  {:>8.5f}  {:>8}  {:>8}  {:>9}  {:>9.2f}  "
        "{:>9.2f}\n",
        contender.info->name, width, vertex_counts(contender).mean, summary.triangle_count.mean, summary.rms.mean,
        summary.mean.mean, summary.max.mean, or_dash(summary.flicker, 1, "", 5), or_dash(summary.changed, 100, " %", 2),
        quadric_error ? fmt::format("{:.3e}", quadric_error->mean) : "-",
        milliseconds(contender, &MethodFrame::adapt_seconds).mean,
        milliseconds(contender, &MethodFrame::extract_seconds).mean);
  }
  if (contenders.size() < 2) return table;
  table += fmt::format("\nrelative to {}\n{:<{}}  {:>8}  {:>8}  {:>11}  {:>8}  {:>8}\n", contenders.front().info->name,
                       "method", width, "rms", "of means", "worst frame", "QEM", "time");
  for (std::size_t i = 1; i < contenders.size(); ++i) {
    const Relative relative = comparison.relative(i);
    table +=
        fmt::format("{:<{}}  {:>8.3f}  {:>8.3f}  {:>11.3f}  {:>8}  {:>8.3f}\n", contenders[i].info->name, width,
                    relative.rms_by_frame, relative.rms_by_mean, relative.rms_worst,
                    relative.quadric_error ? fmt::format("{:.3f}", *relative.quadric_error) : "-", relative.adapt_time);
  }
  return table;
}

}  // namespace limber::eval
