// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fmt/format.h>

#include "eval/report/charts.h"
#include "eval/report/words.h"

namespace limber::eval {

std::string draw_histogram(const Histogram& histogram) {
  Plot plot{.width = 300, .height = 190};
  plot.left = 32, plot.right = plot.width - 6;
  plot.top = 26, plot.bottom = plot.height - 42;
  const std::size_t bar_count = std::max<std::size_t>(histogram.shares.size(), 1);
  const double bar = (plot.right - plot.left) / static_cast<double>(bar_count);
  plot.x = linear_axis(0, histogram.high, 4);
  // The bars end where the drawing does, whatever tick would come next.
  plot.x.high =
      histogram.high * static_cast<double>(bar_count) / static_cast<double>(std::max<std::size_t>(bar_count - 1, 1));
  std::erase_if(plot.x.ticks, [&](double tick) { return tick > histogram.high * (1 + 1e-9); });
  plot.y = linear_axis(0, 100 * histogram.top, 3);
  plot.x_title = histogram.x_title;
  plot.y_title = "% of the surface";

  std::string svg = open_svg(plot.width, plot.height, histogram.name) + draw_axes(plot);
  svg += fmt::format("<g class=\"{}\">", histogram.mark.color_class());
  for (std::size_t i = 0; i < histogram.shares.size(); ++i) {
    const double y = plot.y_at(100 * histogram.shares[i]);
    const bool beyond = i + 1 == bar_count;
    const double low =
        histogram.high * static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(bar_count - 1, 1));
    svg += fmt::format(
        "<rect class=\"{}\" x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\"><title>{} {}: {} % of the "
        "surface</title></rect>",
        beyond ? "bar beyond" : "bar", plot.left + bar * static_cast<double>(i), y, std::max(bar - 0.6, 0.5),
        std::max(plot.bottom - y, 0.0), beyond ? "beyond" : "from", number(low), number(100 * histogram.shares[i]));
  }
  svg += "</g>\n";
  if (!histogram.comparison.empty()) {
    std::string path;
    for (std::size_t i = 0; i < histogram.comparison.size(); ++i) {
      path += fmt::format("{}{:.1f} {:.1f}H{:.1f}", i == 0 ? 'M' : 'L', plot.left + bar * static_cast<double>(i),
                          plot.y_at(100 * histogram.comparison[i]), plot.left + bar * static_cast<double>(i + 1));
    }
    svg += fmt::format("<path class=\"outline\" d=\"{}\"/>\n", path);
  }
  const double x = plot.x_at(histogram.marked);
  svg += fmt::format(
      "<path class=\"marked\" d=\"M{:.1f} {:.1f}V{:.1f}\"><title>95 of 100 points are nearer than {}</title></path>\n",
      x, plot.top, plot.bottom, number(histogram.marked));
  return svg + "</svg>\n";
}

}  // namespace limber::eval
