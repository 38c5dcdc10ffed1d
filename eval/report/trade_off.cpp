// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "eval/report/charts.h"
#include "eval/report/words.h"

namespace limber::eval {

std::string draw_trade_off(const TradeOff& chart, Room room) {
  const bool wide = room == Room::kWide;
  std::vector<const TradeOff::Point*> points;
  double share = 0, low = 1, high = 1;
  std::size_t longest = 0;
  for (const TradeOff::Point& point : chart.points) {
    if (!std::isfinite(point.share) || !std::isfinite(point.error)) continue;
    points.push_back(&point);
    share = std::max(share, point.share);
    low = std::min(low, point.error), high = std::max(high, point.error);
    longest = std::max(longest, point.name.size());
  }
  Plot plot{.width = wide ? 980.0 : 360.0, .height = wide ? 480.0 : 400.0};
  plot.left = 46;
  plot.right = plot.width - 24 - 7.0 * static_cast<double>(longest);
  plot.top = 26;
  plot.bottom = plot.height - 44;
  plot.x = share_axis(share);
  // Not from 0: a ratio has its zero at 1.
  const double room_below = 0.08 * (high - low) + 0.02;
  plot.y = linear_axis(std::max(0.0, low - room_below), high + room_below, wide ? 6 : 5);
  plot.x_title = chart.x_title;
  plot.y_title = chart.y_title;

  std::string svg = open_svg(plot.width, plot.height, chart.name) + draw_axes(plot, true);
  svg += fmt::format("<path class=\"reference\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", plot.left, plot.y_at(1), plot.right);
  // Labels in the way of each other are those of points above each other.
  std::vector<bool> placed(points.size(), false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (placed[i]) continue;
    std::vector<std::size_t> column;
    std::vector<double> wanted;
    for (std::size_t j = i; j < points.size(); ++j) {
      const double distance = plot.x_at(points[j]->share) - plot.x_at(points[i]->share);
      if (placed[j] || std::abs(distance) > 12 + 7.0 * static_cast<double>(longest)) continue;
      placed[j] = true;
      column.push_back(j);
      wanted.push_back(plot.y_at(points[j]->error));
    }
    const std::vector<double> places = spread_labels(wanted, 15, plot.top + 4, plot.bottom - 4);
    for (std::size_t k = 0; k < column.size(); ++k) {
      const TradeOff::Point& point = *points[column[k]];
      const double x = plot.x_at(point.share), y = wanted[k];
      const bool hollow = !point.mark.dashes().empty();
      svg += fmt::format(
          "<g class=\"{}\"><path class=\"leader\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/><circle class=\"{}\" "
          "cx=\"{:.1f}\" "
          "cy=\"{:.1f}\" r=\"5\"><title>{}: {} times the error, {} % of the triangles changed</title></circle><text "
          "class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text></g>\n",
          point.mark.color_class(), x + 6, y, x + 13, places[k], hollow ? "ring" : "dot", x, y, escaped(point.name),
          number(point.error), number(100 * point.share), x + 16, places[k] + 4, escaped(point.name));
    }
  }
  return svg + "</svg>\n";
}

}  // namespace limber::eval
