// SPDX-License-Identifier: Apache-2.0
// Pieces of drawings: the frame of a chart with its axes, and what marks a method in all charts.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eval/report/axis.h"

namespace limber::eval {

// How a method looks wherever it is shown: eight colours, and then the same but the first with broken lines.
struct MethodMark {
  std::size_t number = 0;  // its place among the methods of the report

  // The class that sets its colour, and what breaks its line (empty: nothing).
  std::string color_class() const;
  std::string_view dashes() const;
};

// A short piece of the method's line, for tables and keys.
std::string swatch(MethodMark mark);

// Where in a drawing the values lie, in its pixels.
struct Plot {
  double width = 0, height = 0;  // of the drawing
  double left = 0, right = 0, top = 0, bottom = 0;
  Axis x{}, y{};
  std::string x_title{}, y_title{};

  double x_at(double value) const { return left + (right - left) * x.place(value); }
  double y_at(double value) const { return bottom - (bottom - top) * y.place(value); }
};

// Opens a drawing that a screen reader calls by the given name. The caller closes it with "</svg>".
std::string open_svg(double width, double height, std::string_view name);

// One drawing of several of the same size, four in a row.
std::string side_by_side(std::span<const std::string> drawings, double width, double height, std::string_view name);

// Grid, ticks and titles. `labels` of ticks: percent of shares instead of the number where `x_is_share`.
std::string draw_axes(const Plot& plot, bool x_is_share = false);

// Vertical places of labels that would like to stand at `wanted`, moved as little as needed to be `gap` apart and
// between `low` and `high`, in the same order. More than there is room for are set closer.
std::vector<double> spread_labels(const std::vector<double>& wanted, double gap, double low, double high);

}  // namespace limber::eval
