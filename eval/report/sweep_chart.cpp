// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "eval/report/charts.h"
#include "eval/report/words.h"

namespace limber::eval {
namespace {

constexpr double kWideRange = 30;  // between the least and the largest positive value: from here on they are spread

// The values themselves are the ticks.
Axis parameter_axis(const SweepChart& chart) {
  Axis axis{.low = 0, .high = 1, .ticks = {}};
  if (chart.points.empty()) return axis;
  double least = std::numeric_limits<double>::infinity();
  for (const SweepChart::Point& point : chart.points) {
    axis.ticks.push_back(point.x);
    if (point.x > 0) least = std::min(least, point.x);
  }
  axis.low = axis.ticks.front(), axis.high = axis.ticks.back();
  if (axis.high >= kWideRange * least && axis.low >= 0)
    axis.scale = axis.low > 0 ? Scale::kLogarithmic : Scale::kSquareRoot;
  return axis;
}

}  // namespace

std::string draw_sweep_chart(const SweepChart& chart) {
  double low = chart.from, high = chart.from;
  for (const SweepChart::Point& point : chart.points) {
    if (std::isfinite(point.y)) low = std::min(low, point.y), high = std::max(high, point.y);
  }
  Plot plot{.width = 320, .height = 240};
  plot.left = 44, plot.right = plot.width - 14;
  plot.top = 28, plot.bottom = plot.height - 44;
  plot.x = parameter_axis(chart);
  // A step below, so that a line at the lower end is not one with the axis.
  plot.y = linear_axis(low < chart.from ? low - 0.1 * (high - low) : low, high, 4);
  plot.x_title = chart.x_title;
  plot.y_title = chart.y_title;

  std::string svg = open_svg(plot.width, plot.height, chart.name) + draw_axes(plot);
  const auto is_used = [&](const SweepChart::Point& point) { return point.x == chart.used; };
  if (std::ranges::any_of(chart.points, is_used)) {
    svg += fmt::format("<path class=\"marked\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>\n", plot.x_at(chart.used), plot.top,
                       plot.bottom);
  }
  std::string path, dots;
  bool drawing = false;
  for (const SweepChart::Point& point : chart.points) {
    if (!std::isfinite(point.y)) {
      drawing = false;
      continue;
    }
    const double x = plot.x_at(point.x), y = plot.y_at(point.y);
    path += fmt::format("{}{:.1f} {:.1f}", drawing ? 'L' : 'M', x, y);
    drawing = true;
    dots += fmt::format("<circle class=\"dot\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"><title>{:g}: {}</title></circle>",
                        x, y, point.x, number(point.y));
  }
  svg += fmt::format("<g class=\"{}\"><path class=\"line\" d=\"{}\"/>{}</g>\n", chart.mark.color_class(), path, dots);
  return svg + "</svg>\n";
}

}  // namespace limber::eval
