// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/quantizer.h"

#include <gtest/gtest.h>
#include <limits>

namespace limber {
namespace {

using Limits = std::numeric_limits<float>;

TEST(Quantizer, OrdersFloatsAsTheyAre) {
  const float ordered[] = {-Limits::infinity(),   -Limits::max(), -1.0f,         -Limits::min(),
                           -Limits::denorm_min(), -0.0f,          0.0f,          Limits::denorm_min(),
                           Limits::min(),         1.0f,           Limits::max(), Limits::infinity()};
  for (std::size_t i = 1; i < std::size(ordered); ++i)
    EXPECT_LT(ordered_from_float(ordered[i - 1]), ordered_from_float(ordered[i]));
  EXPECT_EQ(ordered_from_float(0.0f) - ordered_from_float(-0.0f), 1);
}

TEST(Quantizer, LosslessReturnsEveryBit) {
  const Quantizer quantizer{StreamHeader{}};
  for (const float f : {-0.0f, 0.0f, Limits::denorm_min(), -Limits::denorm_min(), 1.0f / 3.0f, -Limits::max()}) {
    const Vec3f back = quantizer.position(quantizer.lattice({f, -f, f}));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back.x), std::bit_cast<std::uint32_t>(f));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(back.y), std::bit_cast<std::uint32_t>(-f));
  }
}

TEST(Quantizer, TakesTheNearestLatticePoint) {
  StreamHeader header;
  header.step = 0.25;
  header.origin = {1.0, 0.0, 0.0};
  const Quantizer quantizer(header);
  EXPECT_EQ(quantizer.lattice({1.0f, 0.12f, -0.13f}), (Lattice{0, 0, -1}));
  EXPECT_EQ(quantizer.position({4, -2, 1}), (Vec3f{2.0f, -0.5f, 0.25f}));
}

TEST(Quantizer, RefusesWhatIsTooFar) {
  StreamHeader header;
  header.step = 0.5;
  const Quantizer quantizer(header);
  EXPECT_TRUE(quantizer.fits({5e8f, 0, 0}));
  EXPECT_FALSE(quantizer.fits({0, -6e8f, 0}));
}

}  // namespace
}  // namespace limber
