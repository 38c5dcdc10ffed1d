// SPDX-License-Identifier: Apache-2.0
// The distance of real meshes, against values that two independent programs gave.
#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>

#include "eval/distance.h"
#include "tests/eval/shapes.h"
#include "tests/support/data.h"

namespace limber::eval {
namespace {

using test::Shape;

// Triangles without texture coordinates or normals, as the pairs have them.
Shape read_triangles(const std::filesystem::path& path) {
  Shape shape;
  std::ifstream file(path);
  std::string text;
  while (std::getline(file, text)) {
    std::istringstream line(text);
    std::string kind;
    line >> kind;
    if (kind == "v") {
      Vec3f p;
      line >> p.x >> p.y >> p.z;
      shape.positions.push_back(p);
    } else if (kind == "f") {
      Triangle t;
      line >> t[0] >> t[1] >> t[2];
      shape.triangles.push_back({t[0] - 1, t[1] - 1, t[2] - 1});
    }
  }
  return shape;
}

struct Expected {
  double rms, mean, max;
};

struct Pair {
  std::string original, approximation;
  Expected area, metro;
};

const std::array<Pair, 4> kPairs = {{
    {"horse", "horse_800_qslim", {.0533, .0405, .535}, {.0612, .0464, .540}},
    {"horse", "horse_800_lt", {.0460, .0321, .808}, {.0516, .0368, .785}},
    {"horse", "horse_800_sloppy", {.2173, .1390, 1.301}, {.2474, .1670, 1.319}},
    {"bunny", "bunny_522_vtk", {.1306, .1010, .910}, {.1310, .1013, .920}},
}};

TEST(MeasurePairs, AreMeasuredAsByOtherPrograms) {
  LIMBER_DATA_SET(folder, "measure-pairs");
  for (const Pair& pair : kPairs) {
    SCOPED_TRACE(pair.approximation);
    const Shape original = read_triangles(folder / (pair.original + ".obj"));
    const Shape approximation = read_triangles(folder / (pair.approximation + ".obj"));

    const Distance area = measure_distance(original, approximation);
    EXPECT_NEAR(area.rms, pair.area.rms, 0.01 * pair.area.rms);
    EXPECT_NEAR(area.mean, pair.area.mean, 0.01 * pair.area.mean);
    EXPECT_NEAR(area.max, pair.area.max, 0.05 * pair.area.max);
    EXPECT_LT(area.rms_error, 0.01 * area.rms);

    const Distance metro = measure_distance(original, approximation, {.sampling = Sampling::kMetro});
    EXPECT_NEAR(metro.rms, pair.metro.rms, 0.01 * pair.metro.rms);
    EXPECT_NEAR(metro.mean, pair.metro.mean, 0.01 * pair.metro.mean);
    EXPECT_NEAR(metro.max, pair.metro.max, 0.05 * pair.metro.max);
  }
}

}  // namespace
}  // namespace limber::eval
