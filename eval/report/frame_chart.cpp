// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "eval/report/charts.h"
#include "eval/report/words.h"

namespace limber::eval {
namespace {

// More points than a line has pixels say nothing: of each run the least and the largest are drawn.
constexpr std::size_t kMostPoints = 1200;
// Frames that a resting pointer tells apart.
constexpr std::size_t kMostStrips = 240;

std::size_t frame_count(const FrameChart& chart) {
  std::size_t frames = 0;
  for (const Series& series : chart.series) frames = std::max(frames, series.values.size());
  return frames;
}

bool is_cut(const FrameChart& chart) { return chart.top > chart.low; }

Axis value_axis(const FrameChart& chart) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Series& series : chart.series) {
    for (const double value : series.values) {
      if (!std::isfinite(value) || (chart.logarithmic && !(value > 0))) continue;
      low = std::min(low, value), high = std::max(high, value);
    }
  }
  if (is_cut(chart)) return linear_axis(chart.low, chart.top, 6);
  return chart.logarithmic ? logarithmic_axis(low, high) : linear_axis(0, high, 6);
}

std::string path_of(const Series& series, const FrameChart& chart, const Plot& plot) {
  std::string path;
  bool drawing = false;
  double last_frame = 0, last_value = 0;
  const double top = is_cut(chart) ? plot.y.high : std::numeric_limits<double>::infinity();
  const auto draw_to = [&](double frame, double value) {
    path += fmt::format("{}{:.1f} {:.1f}", drawing ? 'L' : 'M', plot.x_at(frame), plot.y_at(value));
    drawing = true;
  };
  const auto point = [&](std::size_t t) {
    const double frame = chart.first_frame + static_cast<double>(t), value = series.values[t];
    const bool follows = t > 0 && std::isfinite(last_value) && std::isfinite(value);
    if (follows && (value > top) != (last_value > top))
      draw_to(last_frame + (frame - last_frame) * (top - last_value) / (value - last_value), top);
    if (std::isfinite(value) && value <= top)
      draw_to(frame, value);
    else
      drawing = false;
    last_frame = frame, last_value = value;
  };
  const std::size_t run = std::max<std::size_t>(1, 2 * series.values.size() / kMostPoints);
  for (std::size_t first = 0; first < series.values.size(); first += run) {
    const std::size_t end = std::min(first + run, series.values.size());
    const auto [least, most] = std::minmax_element(series.values.begin() + static_cast<std::ptrdiff_t>(first),
                                                   series.values.begin() + static_cast<std::ptrdiff_t>(end));
    const auto a = static_cast<std::size_t>(least - series.values.begin());
    const auto b = static_cast<std::size_t>(most - series.values.begin());
    point(std::min(a, b));
    if (a != b) point(std::max(a, b));
  }
  return path;
}

double last_finite(const std::vector<double>& values) {
  const auto found = std::find_if(values.rbegin(), values.rend(), [](double v) { return std::isfinite(v); });
  return found == values.rend() ? std::numeric_limits<double>::quiet_NaN() : *found;
}

std::string line_labels(const FrameChart& chart, const Plot& plot) {
  std::vector<const Series*> labelled;
  std::vector<double> ends;
  for (const Series& series : chart.series) {
    const double end = last_finite(series.values);
    if (std::isnan(end) || (is_cut(chart) && end > plot.y.high)) continue;
    labelled.push_back(&series);
    ends.push_back(plot.y_at(end));
  }
  const std::vector<double> places = spread_labels(ends, 15, plot.top + 4, plot.bottom - 2);
  std::string svg;
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    svg += fmt::format(
        "<g class=\"{}\"><path class=\"leader\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/><text class=\"name\" x=\"{:.1f}\" "
        "y=\"{:.1f}\">{}</text></g>\n",
        labelled[i]->mark.color_class(), plot.right + 2, ends[i], plot.right + 14, places[i], plot.right + 17,
        places[i] + 4, escaped(labelled[i]->name));
  }
  return svg;
}

// Invisible strips, each with the values of its frame, in the order of their size.
std::string hover_strips(const FrameChart& chart, const Plot& plot) {
  const std::size_t frames = frame_count(chart);
  const std::size_t run = (frames + kMostStrips - 1) / kMostStrips;
  std::string svg = "<g class=\"hover\">\n";
  for (std::size_t t = 0; t < frames; t += run) {
    std::vector<const Series*> order;
    for (const Series& series : chart.series) {
      if (t < series.values.size() && std::isfinite(series.values[t])) order.push_back(&series);
    }
    std::stable_sort(order.begin(), order.end(), [t](auto* a, auto* b) { return a->values[t] > b->values[t]; });
    const double frame = chart.first_frame + static_cast<double>(t), half = static_cast<double>(run) / 2;
    const double left = plot.x_at(frame - half), right = plot.x_at(frame + half);
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>frame {:.0f}", left,
                       plot.top, std::max(right - left, 1.0), plot.bottom - plot.top, frame);
    for (const Series* series : order) svg += fmt::format("\n{}  {}", escaped(series->name), number(series->values[t]));
    svg += "</title></rect>\n";
  }
  return svg + "</g>\n";
}

}  // namespace

std::string draw_frame_chart(const FrameChart& chart, Room room) {
  const bool wide = room == Room::kWide;
  std::size_t longest = 0;
  for (const Series& series : chart.series) longest = std::max(longest, series.name.size());
  Plot plot{.width = wide ? 980.0 : 360.0, .height = wide ? 420.0 : 300.0};
  plot.left = 46;
  plot.right = plot.width - (wide ? 26 + 7.0 * static_cast<double>(longest) : 8);
  plot.top = 26;
  plot.bottom = plot.height - 44;
  const std::size_t frames = frame_count(chart);
  plot.x = frame_axis(chart.first_frame, chart.first_frame + static_cast<double>(std::max<std::size_t>(frames, 1) - 1),
                      wide ? 10 : 5);
  plot.y = value_axis(chart);
  plot.x_title = "frame";
  plot.y_title = chart.y_title;

  std::string svg = open_svg(plot.width, plot.height, chart.name) + draw_axes(plot);
  for (const Series& series : chart.series) {
    const std::string_view dashes = series.mark.dashes();
    svg += fmt::format("<g class=\"{}\"><path class=\"line\" stroke-dasharray=\"{}\" d=\"{}\"/>",
                       series.mark.color_class(), dashes.empty() ? "none" : dashes, path_of(series, chart, plot));
    // A line of one point shows nothing.
    if (series.values.size() == 1 && std::isfinite(series.values[0])) {
      svg += fmt::format("<circle class=\"dot\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>", plot.x_at(chart.first_frame),
                         plot.y_at(series.values[0]));
    }
    svg += "</g>\n";
  }
  if (wide) svg += line_labels(chart, plot);
  return svg + hover_strips(chart, plot) + "</svg>\n";
}

}  // namespace limber::eval
