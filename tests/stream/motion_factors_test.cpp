// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/motion_factors.h"

#include <gtest/gtest.h>

#include "tests/stream/sample_clip.h"

namespace limber {
namespace {

// A grid whose vertices are moved by `motion(position, frame)`: bytes of the last of three frames.
template <class Motion>
std::size_t size_of_third_frame(Motion&& motion) {
  const Mesh mesh = test::grid(40, 40);
  const IndexLists incident = incident_triangles(mesh);
  const Traversal traversal = traverse(mesh, incident, neighbors(mesh, incident));
  FinestPositions finest(traversal);
  ResidualStatistics statistics;
  std::size_t size = 0;
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<Lattice> actual;
    for (const Index v : traversal.order)
      actual.push_back(motion(static_cast<int>(v % 40) * 1000, static_cast<int>(v / 40) * 1000, frame));
    ResidualWriter writer(statistics);
    const auto give = [&](Index place) { return actual[place]; };
    if (frame == 0) {
      finest.code_key(writer, give);
    } else {
      finest.code_step(best_motion_factors(traversal, finest, actual), writer, give);
    }
    size = writer.finish().size();
    statistics.update();
  }
  return size;
}

constexpr std::size_t kQuarterBitEach = 1600 / 32;  // per vertex, in bytes

TEST(MotionFactors, MakeATranslationAlmostFree) {
  EXPECT_LT(size_of_third_frame([](int x, int y, int t) {
              return Lattice{x + 777 * t * t, y, 31 * t};
            }),
            16 + 3 * kQuarterBitEach);
}

TEST(MotionFactors, SpendElevenBitsAVertexOnAnAffineMotionOfThousandsOfSteps) {
  EXPECT_LT(size_of_third_frame([](int x, int y, int t) {
              return Lattice{x - t * t * y / 8, y + t * x / 4, x * t / 2};
            }),
            16 + 11 * 1600 / 8);
}

TEST(MotionFactors, OfAClipThatStandsStillLeaveNothing) {
  EXPECT_LT(size_of_third_frame([](int x, int y, int) {
              return Lattice{x, y, x * y / 1000};
            }),
            16 + 3 * kQuarterBitEach);
}

}  // namespace
}  // namespace limber
