// SPDX-License-Identifier: Apache-2.0
#include "limber/base/portable_math.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>

namespace limber {
namespace {

double relative_error(double value, double expected) {
  return expected == 0.0 ? std::fabs(value) : std::fabs(value - expected) / std::fabs(expected);
}

TEST(PortableMath, SineAndCosineAgreeWithTheCLibraryFarFromTheOrigin) {
  for (int i = -20000; i <= 20000; ++i) {
    const double x = i * 0.731 + 0.01;
    EXPECT_NEAR(portable_sin(x), std::sin(x), 1e-15) << x;
    EXPECT_NEAR(portable_cos(x), std::cos(x), 1e-15) << x;
  }
  EXPECT_NEAR(portable_sin(999999.0), std::sin(999999.0), 1e-15);
  EXPECT_NEAR(portable_cos(-999999.0), std::cos(999999.0), 1e-15);
}

TEST(PortableMath, SineKeepsItsRelativeErrorNearZero) {
  for (double x = 1e-300; x < 0.7; x *= 3.1) EXPECT_LT(relative_error(portable_sin(x), std::sin(x)), 1e-15) << x;
}

TEST(PortableMath, ExpAndLogAgreeWithTheCLibrary) {
  for (int i = -7000; i <= 7000; ++i) {
    const double x = i * 0.1001;
    EXPECT_LT(relative_error(portable_exp(x), std::exp(x)), 1e-14) << x;
  }
  for (double x = 1e-300; x < 1e300; x *= 1.7) EXPECT_LT(relative_error(portable_log(x), std::log(x)), 1e-14) << x;
  for (double d = 1e-15; d < 0.3; d *= 1.9) {
    EXPECT_LT(relative_error(portable_log(1.0 + d), std::log(1.0 + d)), 1e-14) << d;
    EXPECT_LT(relative_error(portable_log(1.0 - d), std::log(1.0 - d)), 1e-14) << d;
  }
}

TEST(PortableMath, ExpEndsInZeroAndInfinity) {
  EXPECT_EQ(portable_exp(-1000.0), 0.0);
  EXPECT_EQ(portable_exp(1000.0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(portable_exp(0.0), 1.0);
  EXPECT_EQ(portable_log(1.0), 0.0);
}

TEST(PortableMath, PowAgreesWithTheCLibrary) {
  for (double x = 1e-4; x < 1e4; x *= 1.37) {
    for (double y = -9.0; y < 9.0; y += 0.61) EXPECT_LT(relative_error(portable_pow(x, y), std::pow(x, y)), 1e-13);
  }
  EXPECT_EQ(portable_pow(0.0, 0.5), 0.0);
}

// The bits, not the value: what makes the samples the same everywhere.
TEST(PortableMath, GivesTheSameBitsOnEveryPlatform) {
  std::uint64_t hash = 14695981039346656037u;
  for (int i = 1; i < 2000; ++i) {
    const double x = i * 0.37;
    for (const double value : {portable_sin(x), portable_cos(x), portable_exp(-0.1 * x), portable_log(x)}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
    }
  }
  EXPECT_EQ(hash, 17069114886193483235u);
}

}  // namespace
}  // namespace limber
