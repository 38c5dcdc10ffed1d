// SPDX-License-Identifier: Apache-2.0
// The charts of the report as SVG. Colours come from the page's style (style.h); text is text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "eval/report/svg.h"

namespace limber::eval {

// A method's values, a number per frame or several; what is not finite leaves a gap.
struct Series {
  std::string name{};
  MethodMark mark{};
  std::vector<double> values{};
};

struct FrameChart {
  std::string name{};     // for screen readers
  std::string y_title{};  // what is shown, and its unit
  bool logarithmic = false;
  double low = 0, top = 0;  // of the y axis where top is above low: lines are cut off at the top; else to suit
  std::uint32_t first_frame = 0;
  std::vector<Series> series{};  // each with a value per frame
};

struct TradeOff {
  std::string name{};
  std::string x_title{}, y_title{};
  struct Point {
    std::string name{};
    MethodMark mark{};
    double share = 0;  // 0 to 1
    double error = 0;
  };
  std::vector<Point> points{};
};

struct Histogram {
  std::string name{};
  std::string x_title{};
  MethodMark mark{};
  double high = 1;                   // end of the last bar but one; the last holds all beyond
  double top = 1;                    // of the y axis: a share
  double marked = 0;                 // a value with a line of its own
  std::vector<double> shares{};      // of the bars; sum 1
  std::vector<double> comparison{};  // the same of the first method, as an outline; may be empty
};

// One value over a parameter.
struct SweepChart {
  std::string name{};
  std::string x_title{}, y_title{};
  MethodMark mark{};
  double from = 0;  // the y axis starts here, or lower where a value does
  double used = 0;  // a value of the parameter with a line of its own, if it is among the points'
  struct Point {
    double x = 0, y = 0;  // y: not finite leaves a gap
  };
  std::vector<Point> points{};  // by rising x
};

// How much room a chart has. Wide ones have labels at their lines; narrow ones leave them to a key beside the chart.
enum class Room { kWide, kNarrow };

// A value per frame as lines, with what all methods have in a frame shown where the pointer rests.
std::string draw_frame_chart(const FrameChart& chart, Room room);

// Error over change. Points whose values are not finite are left out.
std::string draw_trade_off(const TradeOff& chart, Room room);

// One of several small ones that share their axes.
std::string draw_histogram(const Histogram& histogram);

// One of several that stand side by side.
std::string draw_sweep_chart(const SweepChart& chart);

}  // namespace limber::eval
