// SPDX-License-Identifier: Apache-2.0
// Axes of charts: where their ticks stand and how values become places.
#pragma once

#include <string>
#include <vector>

namespace limber::eval {

enum class Scale {
  kLinear,
  kLogarithmic,
  kSquareRoot,  // from 0: spreads small values without losing 0
};

struct Axis {
  Scale scale = Scale::kLinear;
  double low = 0;
  double high = 1;
  std::vector<double> ticks;  // rising, in [low, high]

  // 0 at low, 1 at high; values outside are brought to the nearest end. Precondition: the value is finite.
  double place(double value) const;
};

// Ticks at multiples of 1, 2 or 5 times a power of ten, about `wanted` (>= 2) of them. `low` stays where it is, `high`
// moves up to a tick. Values that are not finite, or equal, give an axis all the same.
Axis linear_axis(double low, double high, int wanted = 5);

// Ends and ticks at whole numbers: of frames. Both ends stay.
Axis frame_axis(double low, double high, int wanted = 8);

// Ticks at 1, 2 and 5 times powers of ten, or at powers of ten only where these are many. Values at or below 0 do not
// fit: `low` is then a thousandth of `high`.
Axis logarithmic_axis(double low, double high);

// From 0 to `high`, at most 1: shares, with ticks at round percentages.
Axis share_axis(double high);

// As few digits as tell it from its neighbours.
std::string tick_label(const Axis& axis, double tick);

}  // namespace limber::eval
