// SPDX-License-Identifier: Apache-2.0
// A flag in the wind. Each thread runs away from the pole without stretching: its direction is a sum of travelling
// waves that grow with the distance from the pole, and its place is the integral of that direction, tabulated once
// per frame. Fine wrinkles are added across the cloth.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "limber/base/portable_math.h"
#include "limber/clip/sample_motion.h"

namespace limber {
namespace {

constexpr double kWidth = 1.5, kHeight = 1.0;
constexpr double kFramesPerSecond = 24.0;
constexpr std::size_t kThreads = 49, kSteps = 241;  // of the table

// Rows of nearly equal counts whose sum is exact; neighbouring rows are joined by the shorter diagonals.
struct Cloth {
  Mesh mesh;
  std::vector<std::array<double, 2>> places;  // [vertex_count], from the pole and from the lower edge, 0 to 1
};

// A number from -1 to 1 that looks random.
double scatter(std::uint32_t x) {
  x ^= x >> 16, x *= 0x7feb352du, x ^= x >> 15, x *= 0x846ca68bu, x ^= x >> 16;
  return x * (2.0 / 4294967295.0) - 1.0;
}

Cloth make_cloth(Index vertex_count) {
  const Index rows = static_cast<Index>(std::floor(std::sqrt(vertex_count * (kHeight / kWidth)) * 1.06 + 0.5));
  Cloth cloth;
  cloth.mesh.vertex_count = vertex_count;
  const auto first_of = [&](Index row) {
    return static_cast<Index>(static_cast<std::uint64_t>(row) * vertex_count / rows);
  };
  for (Index row = 0; row < rows; ++row) {
    const Index first = first_of(row), count = first_of(row + 1) - first;
    for (Index i = 0; i < count; ++i) {
      // Every other row is shifted by half a step; the border stays straight.
      const double shift = row % 2 == 0 ? 0.25 : -0.25;
      double along = i + (i == 0 || i + 1 == count ? 0.0 : shift + 0.22 * scatter(2 * (first + i)));
      double across = row + (row == 0 || row + 1 == rows ? 0.0 : 0.22 * scatter(2 * (first + i) + 1));
      cloth.places.push_back({along / (count - 1), across / (rows - 1)});
    }
  }
  const auto distance2 = [&](Index a, Index b) {
    const double dx = (cloth.places[a][0] - cloth.places[b][0]) * kWidth;
    const double dy = (cloth.places[a][1] - cloth.places[b][1]) * kHeight;
    return dx * dx + dy * dy;
  };
  for (Index row = 0; row + 1 < rows; ++row) {
    Index low = first_of(row), high = first_of(row + 1);
    const Index low_last = high - 1, high_last = first_of(row + 2) - 1;
    while (low < low_last || high < high_last) {
      const bool step_low =
          high == high_last || (low < low_last && distance2(low + 1, high) < distance2(low, high + 1));
      cloth.mesh.triangles.push_back(step_low ? Triangle{low, low + 1, high} : Triangle{low, high + 1, high});
      ++(step_low ? low : high);
    }
  }
  return cloth;
}

// The angle of a thread's direction, from straight away from the pole, in radians.
double angle_at(double along, double across, double time) {
  const double free = along * (1.6 - 0.6 * along) * portable_exp(-0.10 / (along + 0.02));
  const double slant = 0.35 * (across - 0.5);
  return free * (1.05 * portable_sin(2.0 * kPi * (1.15 * along - 1.30 * time + slant)) +
                 0.66 * portable_sin(2.0 * kPi * (2.1 * along - 2.15 * time - 0.9 * slant + 0.3)) +
                 0.42 * portable_sin(2.0 * kPi * (3.7 * along - 3.1 * time + 0.55 * across + 0.1)) +
                 0.24 * portable_sin(2.0 * kPi * (6.1 * along - 4.3 * time - 0.85 * across)) +
                 0.25 * portable_sin(2.0 * kPi * (0.37 * time)));
}

// Small folds that run out from the two corners at the pole, and flutter at the free end.
double wrinkle_at(double along, double across, double time) {
  const double up = 1.0 - across;
  const double top = std::sqrt(along * along * 2.25 + up * up),
               bottom = std::sqrt(along * along * 2.25 + across * across);
  const double from_top = up / (along * 1.5 + 0.06), from_bottom = across / (along * 1.5 + 0.06);
  const double near = std::clamp(along * 12.0, 0.0, 1.0);
  return near * (0.011 * portable_exp(-1.8 * top) * portable_sin(7.0 * from_top / (1.0 + 0.4 * from_top) + 1.5 * time) +
                 0.009 * portable_exp(-2.2 * bottom) *
                     portable_sin(8.0 * from_bottom / (1.0 + 0.4 * from_bottom) - 1.1 * time) +
                 0.006 * along * portable_sin(2.0 * kPi * (8.3 * along - 5.2 * time) + 9.0 * across) +
                 0.004 * along * portable_sin(2.0 * kPi * (5.0 * across + 3.1 * along - 3.3 * time)));
}

// Cubic interpolation between samples at -1, 0, 1, 2.
std::array<double, 4> cubic(double t) {
  return {0.5 * t * (-1.0 + t * (2.0 - t)), 0.5 * (2.0 + t * t * (-5.0 + 3.0 * t)),
          0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)};
}

class Flag : public SampleMotion {
 public:
  explicit Flag(Index vertex_count) : cloth_(make_cloth(vertex_count)) {}

  const Mesh& mesh() const override { return cloth_.mesh; }

  void pose(std::uint32_t frame, std::uint32_t, std::span<Vec3f> positions) const override {
    const double time = frame / kFramesPerSecond;
    const std::vector<Vec3d> table = threads_at(time);
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const auto [along, across] = cloth_.places[v];
      positions[v] = static_cast<Vec3f>(place(table, along, across, time));
    }
  }

 private:
  static std::vector<Vec3d> threads_at(double time) {
    std::vector<Vec3d> table;
    table.reserve(kThreads * kSteps);
    for (std::size_t thread = 0; thread < kThreads; ++thread) {
      const double across = static_cast<double>(thread) / (kThreads - 1);
      Vec3d p{0.0, kHeight * (across - 0.5), 0.0};
      constexpr double kStep = kWidth / (kSteps - 1);
      for (std::size_t step = 0; step < kSteps; ++step) {
        table.push_back(p);
        const double along = (static_cast<double>(step) + 0.5) / (kSteps - 1);
        const double angle = angle_at(along, across, time);
        // The weight of the cloth pulls the free end down, and more so between gusts.
        const double fall = along * (0.16 + 0.06 * portable_sin(2.0 * kPi * (0.45 * time - 0.5 * along))) +
                            0.05 * along * portable_sin(2.0 * kPi * (1.4 * along - 1.3 * time));
        const double level = std::sqrt(1.0 - fall * fall);
        p += Vec3d{level * portable_cos(angle), -fall, level * portable_sin(angle)} * kStep;
      }
    }
    return table;
  }

  static Vec3d place(const std::vector<Vec3d>& table, double along, double across, double time) {
    const double x = std::clamp(along, 0.0, 1.0) * (kSteps - 1), y = std::clamp(across, 0.0, 1.0) * (kThreads - 1);
    const int column = std::min(static_cast<int>(x), static_cast<int>(kSteps) - 2);
    const int row = std::min(static_cast<int>(y), static_cast<int>(kThreads) - 2);
    const std::array<double, 4> wx = cubic(x - column), wy = cubic(y - row);
    const auto sample = [&](int i, int j) {
      // Beyond the table's edge it goes on straight.
      const int ci = std::clamp(i, 0, static_cast<int>(kSteps) - 1),
                cj = std::clamp(j, 0, static_cast<int>(kThreads) - 1);
      const auto at = [&](int a, int b) {
        return table[static_cast<std::size_t>(b) * kSteps + static_cast<std::size_t>(a)];
      };
      const int mi = 2 * ci - i, mj = 2 * cj - j;
      return at(ci, cj) * 2.0 - at(mi, mj);
    };
    Vec3d p;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        p += sample(column + i - 1, row + j - 1) * (wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)]);
      }
    }
    const double angle = angle_at(along, across, time), wrinkle = wrinkle_at(along, across, time);
    return p + Vec3d{-portable_sin(angle), 0.0, portable_cos(angle)} * wrinkle;
  }

  Cloth cloth_;
};

}  // namespace

std::unique_ptr<SampleMotion> make_flag(Index vertex_count) { return std::make_unique<Flag>(vertex_count); }

}  // namespace limber
