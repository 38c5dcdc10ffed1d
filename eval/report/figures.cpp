// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fmt/format.h>

#include "eval/report/charts.h"
#include "eval/report/report.h"
#include "eval/report/report_charts.h"
#include "eval/report/style.h"

namespace limber::eval {
namespace {

std::string text_of(std::span<const std::byte> bytes) {
  std::string text(bytes.size(), '\0');
  std::ranges::transform(bytes, text.begin(), [](std::byte b) { return static_cast<char>(b); });
  return text;
}

// Names of parts are the user's.
std::string file_name(std::string_view kind, std::string_view name, std::string_view extension) {
  std::string file = fmt::format("{}-{}", kind, name);
  std::ranges::replace_if(
      file, [](char c) { return std::string_view("/\\:*?\"<>| ").find(c) != std::string_view::npos; }, '-');
  return file + std::string(extension);
}

void add_row(std::vector<ReportFigure>& figures, std::string name, const PictureRow& row) {
  if (!row.sheet.empty()) figures.push_back({std::move(name), text_of(row.sheet)});
}

}  // namespace

std::vector<ReportFigure> report_figures(const Report& report) {
  const std::string first(report.comparison.contenders().front().info->name);
  std::vector<ReportFigure> figures;
  const auto add = [&](std::string name, const std::string& drawing) {
    figures.push_back({std::move(name), standalone(drawing)});
  };
  add("rms.svg", draw_frame_chart(rms_chart(report), Room::kWide));
  if (const auto near = near_rms_chart(report)) add("rms-near.svg", draw_frame_chart(*near, Room::kWide));
  add("trade-off.svg", draw_trade_off(trade_off_chart(report), Room::kWide));
  add("adapt-time.svg", draw_frame_chart(adapt_chart(report), Room::kWide));
  std::vector<std::string> drawings;
  for (const Histogram& histogram : distance_histograms(report)) drawings.push_back(draw_histogram(histogram));
  add("histograms.svg", side_by_side(drawings, 300, 190, "Distances"));
  for (const Sweep& sweep : report.sweeps) {
    drawings.clear();
    for (const SweepChart& chart : sweep_charts(sweep, first)) drawings.push_back(draw_sweep_chart(chart));
    add(file_name("sweep", sweep.parameter, ".svg"), side_by_side(drawings, 320, 240, sweep.parameter));
  }
  for (const PictureRow& row : report.pictures.gallery)
    add_row(figures, fmt::format("frame-{:04}.png", report.clip.first_frame + row.frame), row);
  for (std::size_t part = 0; part < report.pictures.parts.size(); ++part)
    add_row(figures, file_name("part", report.parts->ball(part).name, ".png"), report.pictures.parts[part]);
  for (std::size_t i = 0; i < report.pictures.close_ups.size(); ++i)
    add_row(figures, fmt::format("worst-{}.png", i + 1), report.pictures.close_ups[i].row);
  return figures;
}

}  // namespace limber::eval
