// SPDX-License-Identifier: Apache-2.0
#include "eval/report/svg.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "eval/report/words.h"

namespace limber::eval {
namespace {

constexpr std::size_t kColorCount = 8;
constexpr std::string_view kDashes[] = {"", "7 3", "2 3"};

}  // namespace

// Only the first method is ink.
std::string MethodMark::color_class() const {
  return fmt::format("c{}", number < kColorCount ? number : 1 + (number - 1) % (kColorCount - 1));
}

std::string_view MethodMark::dashes() const {
  return kDashes[std::min<std::size_t>(number == 0 ? 0 : (number - 1) / (kColorCount - 1), std::size(kDashes) - 1)];
}

std::string swatch(MethodMark mark) {
  return fmt::format(
      "<svg class=\"swatch {}\" viewBox=\"0 0 22 10\" width=\"22\" height=\"10\" aria-hidden=\"true\"><path "
      "class=\"line\" "
      "d=\"M1 5H21\" stroke-dasharray=\"{}\"/></svg>",
      mark.color_class(), mark.dashes().empty() ? "none" : mark.dashes());
}

std::string open_svg(double width, double height, std::string_view name) {
  return fmt::format(
      "<svg viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" aria-label=\"{2}\">\n",
      width, height, escaped(name));
}

std::string side_by_side(std::span<const std::string> drawings, double width, double height, std::string_view name) {
  constexpr std::size_t kColumns = 4;
  constexpr double kGap = 20;
  const std::size_t columns = std::min(kColumns, drawings.size());
  const std::size_t rows = (drawings.size() + kColumns - 1) / kColumns;
  std::string svg = open_svg(static_cast<double>(columns) * (width + kGap) - kGap,
                             static_cast<double>(rows) * (height + kGap) - kGap, name);
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    svg += fmt::format("<g transform=\"translate({:.0f} {:.0f})\">{}</g>\n",
                       static_cast<double>(i % kColumns) * (width + kGap),
                       static_cast<double>(i / kColumns) * (height + kGap), drawings[i]);
  }
  return svg + "</svg>\n";
}

std::string draw_axes(const Plot& plot, bool x_is_share) {
  std::string svg = "<g class=\"axes\">\n";
  for (const double tick : plot.y.ticks) {
    const double y = plot.y_at(tick);
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/><text x=\"{:.1f}\" y=\"{:.1f}\" class=\"end\">{}</text>\n",
        plot.left, y, plot.right, plot.left - 7, y + 4, tick_label(plot.y, tick));
  }
  double free_from = -1e9;
  for (const double tick : plot.x.ticks) {
    const double x = plot.x_at(tick);
    svg += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v4\"/>", x, plot.bottom);
    const std::string label = x_is_share ? number(100 * tick, 1) : tick_label(plot.x, tick);
    const double half = 3.6 * static_cast<double>(label.size());
    if (x - half < free_from) continue;
    free_from = x + half + 4;
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"middle\">{}</text>\n", x, plot.bottom + 18, label);
  }
  svg += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n", plot.left, plot.bottom, plot.right);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"middle title\">{}</text>\n", (plot.left + plot.right) / 2,
                     plot.bottom + 36, escaped(plot.x_title));
  svg += fmt::format("<text x=\"0\" y=\"12\" class=\"title\">{}</text>\n</g>\n", escaped(plot.y_title));
  return svg;
}

std::vector<double> spread_labels(const std::vector<double>& wanted, double gap, double low, double high) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  if (wanted.size() > 1) gap = std::min(gap, (high - low) / static_cast<double>(wanted.size() - 1));

  // Groups of labels that touch each other, each as near as it can be to where its labels want to be.
  struct Group {
    double sum = 0;  // of the wanted places, each minus its offset in the group
    std::size_t size = 0;
    double start = 0;
  };
  std::vector<Group> groups;
  for (const std::size_t label : order) {
    groups.push_back({wanted[label], 1, 0});
    for (;;) {
      Group& last = groups.back();
      const auto size = static_cast<double>(last.size);
      last.start = std::clamp(last.sum / size, low, std::max(low, high - gap * (size - 1)));
      if (groups.size() < 2) break;
      Group& before = groups[groups.size() - 2];
      const double end = before.start + gap * static_cast<double>(before.size);
      if (last.start >= end - 1e-9) break;
      before.sum += last.sum - size * gap * static_cast<double>(before.size);
      before.size += last.size;
      groups.pop_back();
    }
  }
  std::vector<double> places(wanted.size());
  std::size_t at = 0;
  for (const Group& group : groups) {
    for (std::size_t k = 0; k < group.size; ++k) places[order[at++]] = group.start + gap * static_cast<double>(k);
  }
  return places;
}

}  // namespace limber::eval
