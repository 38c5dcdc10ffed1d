// SPDX-License-Identifier: Apache-2.0
#include "limber/base/portable_math.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace limber {
namespace {

// Pi/2 and log 2 in pieces whose leading ones end in zeros: a product with a small integer is then exact, and the
// reduced argument keeps all its bits (Cody & Waite, Software Manual for the Elementary Functions, 1980).
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;
constexpr double kLog2High = 0x1.62e42feep-1;
constexpr double kLog2Low = 0x1.a39ef35793c76p-33;

// Taylor series on [-pi/4, pi/4]: the first term left out is below 1e-19.
double sin_series(double r) {
  const double s = r * r;
  double sum = 1.0;
  for (int k = 17; k >= 3; k -= 2) sum = 1.0 - sum * s / ((k - 1.0) * k);
  return r * sum;
}

double cos_series(double r) {
  const double s = r * r;
  double sum = 1.0;
  for (int k = 18; k >= 2; k -= 2) sum = 1.0 - sum * s / ((k - 1.0) * k);
  return sum;
}

// sin(x + quarter_turns * pi/2).
double shifted_sin(double x, int quarter_turns) {
  assert(std::fabs(x) <= 1e6);
  const double turns = std::floor(x * (2.0 / kPi) + 0.5);
  const double r = ((x - turns * kHalfPi1) - turns * kHalfPi2) - turns * kHalfPi3;
  const int quadrant = (static_cast<int>(turns) + quarter_turns) & 3;
  const double value = (quadrant & 1) != 0 ? cos_series(r) : sin_series(r);
  return (quadrant & 2) != 0 ? -value : value;
}

}  // namespace

double portable_sin(double x) { return shifted_sin(x, 0); }

double portable_cos(double x) { return shifted_sin(x, 1); }

double portable_exp(double x) {
  if (x > 709.8) return std::numeric_limits<double>::infinity();
  if (x < -745.2) return 0.0;
  const double power = std::floor(x * (1.0 / (kLog2High + kLog2Low)) + 0.5);
  const double r = (x - power * kLog2High) - power * kLog2Low;
  double sum = 1.0;
  for (int k = 14; k >= 1; --k) sum = 1.0 + sum * r / k;
  return std::ldexp(sum, static_cast<int>(power));
}

double portable_log(double x) {
  assert(x > 0.0 && std::isfinite(x));
  int power = 0;
  double mantissa = std::frexp(x, &power);
  if (mantissa < 0.70710678118654752) mantissa *= 2.0, --power;
  // log m = 2 artanh((m - 1) / (m + 1)), whose argument is at most 0.172.
  const double z = (mantissa - 1.0) / (mantissa + 1.0);
  const double s = z * z;
  double sum = 0.0;
  for (int k = 23; k >= 3; k -= 2) sum = (sum + 1.0 / k) * s;
  return power * kLog2High + (power * kLog2Low + 2.0 * (z + z * sum));
}

double portable_pow(double x, double y) {
  assert(x > 0.0 || y > 0.0);
  return x == 0.0 ? 0.0 : portable_exp(y * portable_log(x));
}

}  // namespace limber
