// SPDX-License-Identifier: Apache-2.0
// Elementary functions that give the same bits on every platform: polynomials after range reduction, made of
// + - * / alone. A C library's own may differ in the last bit from one version to the next. Part of the player.
#pragma once

namespace limber {

inline constexpr double kPi = 3.14159265358979323846;

// Absolute error below 1e-15, relative error below 1e-13 away from the zeros. Precondition: |x| <= 1e6.
double portable_sin(double x);
double portable_cos(double x);

// Relative error below 1e-14 where the result is a normal number; 0 and infinity beyond. x may be infinite.
double portable_exp(double x);

// Relative error below 1e-14. Precondition: x > 0 and finite.
double portable_log(double x);

// x to the power y; relative error below 1e-13 while |y log x| <= 300. portable_pow(0, y) is 0.
// Precondition: x >= 0 and finite; y > 0 where x is 0.
double portable_pow(double x, double y);

}  // namespace limber
