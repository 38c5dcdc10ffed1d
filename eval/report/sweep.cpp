// SPDX-License-Identifier: Apache-2.0
#include "eval/report/sweep.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>

#include "eval/report/words.h"

namespace limber::eval {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
double mean_of(const Contender& contender, const Value& value) {
  double sum = 0;
  for (const MethodFrame& frame : contender.frames) sum += value(frame);
  return sum / static_cast<double>(contender.frames.size());
}

std::optional<double> mean_of(const std::optional<Statistic>& statistic) {
  return statistic ? std::optional(statistic->mean) : std::nullopt;
}

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::string sweep_table(const Sweep& sweep, const std::string& first_method) {
  std::string html = fmt::format(
      "<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">{}</th><th scope=\"col\">RMS<span>% of "
      "diag.</span></th><th scope=\"col\">worst RMS<span>% of diag.</span></th><th "
      "scope=\"col\">RMS<span>\xc3\x97 {}</span></th><th scope=\"col\">max<span>% of diag.</span></th><th "
      "scope=\"col\">flicker<span>% of diag.</span></th><th scope=\"col\">changed<span>% per frame</span></th><th "
      "scope=\"col\">QEM<span>diag.\xe2\x81\xb4</span></th><th scope=\"col\">choices<span>bytes per "
      "frame</span></th><th scope=\"col\">adapt<span>ms</span></th></tr></thead>\n<tbody>\n",
      escaped(sweep.parameter), escaped(first_method));
  for (const SweepPoint& point : sweep.points) {
    const std::optional<double> changed = point.changed ? std::optional(100 * *point.changed) : std::nullopt;
    html += fmt::format(
        "<tr><th scope=\"row\">{}{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        fmt::format("{:g}", point.value), point.value == sweep.used ? " <i>(used otherwise)</i>" : "",
        number(point.rms), number(point.rms_worst), number(point.relative), number(point.max), number(point.flicker),
        number(changed), number(point.quadric_error), number(point.choice_bytes), number(point.adapt_ms));
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

SweepPoint sweep_point(double value, const Comparison& tried, const Comparison& report) {
  const Contender& contender = tried.contenders().front();
  const Contender& first = report.contenders().front();
  const ClipSummary summary = contender.measure.summary();
  SweepPoint point{
      .value = value,
      .rms = summary.rms.mean,
      .rms_worst = summary.rms.worst,
      .max = summary.max.mean,
      .relative = 0,
      .quadric_error = mean_of(contender, [](const MethodFrame& f) { return f.quadric_error.value_or(0); }),
      .flicker = mean_of(summary.flicker),
      .changed = mean_of(summary.changed),
      .choice_bytes = {},
      .adapt_ms = 1000 * mean_of(contender, [](const MethodFrame& f) { return f.adapt_seconds; }),
      .begin_seconds = contender.begin_seconds};
  const double bytes = mean_of(contender, [](const MethodFrame& f) { return static_cast<double>(f.choice_bytes); });
  if (bytes > 0) point.choice_bytes = bytes;
  for (std::size_t t = 0; t < first.frames.size(); ++t) {
    point.relative +=
        rms_ratio(contender.measure.frames()[t], first.measure.frames()[t]) / static_cast<double>(first.frames.size());
  }
  return point;
}

std::vector<SweepChart> sweep_charts(const Sweep& sweep, const std::string& first_method) {
  const auto chart = [&](const std::string& what, double from, const auto& value) {
    SweepChart made{.name = fmt::format("{} over {}", what, sweep.parameter),
                    .x_title = sweep.parameter,
                    .y_title = what,
                    .mark = sweep.mark,
                    .from = from,
                    .used = sweep.used,
                    .points = {}};
    for (const SweepPoint& point : sweep.points) made.points.push_back({point.value, value(point)});
    return made;
  };
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<SweepChart> charts;
  charts.push_back(chart("RMS, \xc3\x97 " + first_method, 1, [](const SweepPoint& point) { return point.relative; }));
  charts.push_back(chart("triangles changed, % per frame", 0,
                         [=](const SweepPoint& point) { return 100 * point.changed.value_or(kNothing); }));
  if (std::ranges::any_of(sweep.points, [](const SweepPoint& point) { return point.choice_bytes.has_value(); })) {
    charts.push_back(chart("choices, bytes per frame", 0,
                           [=](const SweepPoint& point) { return point.choice_bytes.value_or(kNothing); }));
  }
  return charts;
}

std::string sweep_section(const std::vector<Sweep>& sweeps, const std::string& first_method, int figure_number) {
  std::string html = "<section id=\"sweeps\">\n<h2>Parameters</h2>\n";
  for (const Sweep& sweep : sweeps) {
    html += fmt::format("<h3>{}<code>--{}</code> <span>of {}</span></h3>\n<figure><div class=\"three\">\n",
                        swatch(sweep.mark), escaped(sweep.parameter), escaped(sweep.method->name));
    for (const SweepChart& chart : sweep_charts(sweep, first_method)) html += draw_sweep_chart(chart);
    html += "</div>\n" + sweep_table(sweep, first_method);
    html += fmt::format(
        "<figcaption><b>Figure {}.</b> The clip once more for every value of <code>--{}</code>, all else as above. The "
        "broken line is the value used otherwise. <i>choices</i>: what stores which triangles a frame has, coded, "
        "without "
        "positions.</figcaption></figure>\n",
        figure_number++, escaped(sweep.parameter));
  }
  return html + "</section>\n";
}

Json sweeps_json(const std::vector<Sweep>& sweeps) {
  Json json = Json::array();
  for (const Sweep& sweep : sweeps) {
    Json points = Json::array();
    for (const SweepPoint& point : sweep.points) {
      points.push_back({{"value", point.value},
                        {"rms", point.rms},
                        {"rms_worst", point.rms_worst},
                        {"relative_rms", point.relative},
                        {"max", point.max},
                        {"flicker", number_or_null(point.flicker)},
                        {"changed", number_or_null(point.changed)},
                        {"quadric_error", point.quadric_error},
                        {"choice_bytes_per_frame", number_or_null(point.choice_bytes)},
                        {"adapt_ms", point.adapt_ms},
                        {"begin_ms", 1000 * point.begin_seconds}});
    }
    json.push_back(
        {{"parameter", sweep.parameter}, {"method", sweep.method->name}, {"used", sweep.used}, {"points", points}});
  }
  return json;
}

}  // namespace limber::eval
