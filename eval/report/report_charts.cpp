// SPDX-License-Identifier: Apache-2.0
#include "eval/report/report_charts.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace limber::eval {
namespace {

constexpr std::size_t kBars = 24;

std::string name_of(const Report& report, std::size_t method) {
  return std::string(report.comparison.contenders()[method].info->name);
}

template <class Value>
std::vector<Series> series_of(const Report& report, const Value& value) {
  std::vector<Series> all;
  for (std::size_t m = 0; m < report.comparison.contenders().size(); ++m) {
    const Contender& contender = report.comparison.contenders()[m];
    Series series{name_of(report, m), MethodMark{m}, {}};
    for (std::size_t t = 0; t < contender.frames.size(); ++t) series.values.push_back(value(contender, t));
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace

FrameChart rms_chart(const Report& report) {
  return {.name = "RMS distance per frame",
          .y_title = "RMS distance, % of diagonal",
          .first_frame = report.clip.first_frame,
          .series =
              series_of(report, [](const Contender& c, std::size_t t) { return c.measure.frames()[t].distance.rms; })};
}

std::optional<FrameChart> near_rms_chart(const Report& report) {
  FrameChart chart = rms_chart(report);
  const std::vector<double>& first = chart.series.front().values;
  const double top = 1.5 * *std::ranges::max_element(first);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const Series& series : chart.series) {
    const auto [low, high] = std::ranges::minmax_element(series.values);
    least = std::min(least, *low), most = std::max(most, *high);
  }
  if (!(most > 1.5 * top) || !(least > 0)) return std::nullopt;
  chart.name = "RMS distance per frame, magnified";
  chart.low = 0.95 * least;
  chart.top = top;
  return chart;
}

FrameChart adapt_chart(const Report& report) {
  return {
      .name = "Time to adapt each frame",
      .y_title = "processor time, ms (logarithmic)",
      .logarithmic = true,
      .first_frame = report.clip.first_frame,
      .series = series_of(report, [](const Contender& c, std::size_t t) { return 1000 * c.frames[t].adapt_seconds; })};
}

TradeOff trade_off_chart(const Report& report) {
  TradeOff chart{.name = "Error over change",
                 .x_title = "triangles changed per frame, %",
                 .y_title = fmt::format("RMS, \xc3\x97 {}", name_of(report, 0)),
                 .points = {}};
  for (std::size_t m = 0; m < report.comparison.contenders().size(); ++m) {
    const std::optional<Statistic> changed = report.comparison.contenders()[m].measure.summary().changed;
    chart.points.push_back(
        {name_of(report, m), MethodMark{m}, changed ? changed->mean : 0.0, report.comparison.relative(m).rms_by_frame});
  }
  return chart;
}

std::vector<Histogram> distance_histograms(const Report& report) {
  const double high = report.pictures.error_range;
  std::vector<std::vector<double>> shares;
  double top = 0;
  for (std::size_t m = 0; m < report.comparison.contenders().size(); ++m) {
    shares.push_back(report.places.distribution(m).shares(high, kBars));
    // The last bar holds a tail of any length: it may be cut off.
    top = std::max(top, *std::max_element(shares.back().begin(), shares.back().end() - 1));
  }
  std::vector<Histogram> histograms;
  for (std::size_t m = 0; m < shares.size(); ++m) {
    histograms.push_back({.name = fmt::format("Distances of {}", name_of(report, m)),
                          .x_title = "distance, % of diagonal",
                          .mark = MethodMark{m},
                          .high = high,
                          .top = top,
                          .marked = report.places.distribution(m).percentile(0.95),
                          .shares = shares[m],
                          .comparison = m == 0 ? std::vector<double>{} : shares[0]});
  }
  return histograms;
}

}  // namespace limber::eval
