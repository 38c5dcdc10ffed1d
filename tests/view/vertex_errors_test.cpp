// SPDX-License-Identifier: Apache-2.0
#include "limber/view/vertex_errors.h"

#include <gtest/gtest.h>

#include "tests/view/allocations.h"
#include "tests/view/patches.h"

namespace limber {
namespace {

// A square of two triangles of area 1/2 whose four vertices stand below one node, at a distance of 3 from all of it.
TEST(VertexErrors, AreDistancesWhateverTheArea) {
  for (const float scale : {1.0f, 10.0f}) {
    const Mesh mesh{4, {{0, 1, 2}, {0, 2, 3}}};
    FrameState state;
    state.hierarchy.level_begin = {0, 4, 5};
    state.hierarchy.parent = {4, 4, 4, 4, kNone};
    state.positions = {{0, 0, 0}, {scale, 0, 0}, {scale, scale, 0}, {0, scale, 0}, {0, 0, 3}};
    state.errors = {0, 0, 0, 0, 3 * scale};  // sqrt(area x distance^2)
    Cut cut(mesh, state.hierarchy, {.level = 1});
    cut.update(mesh, state);
    VertexErrors errors;
    measure_errors(mesh, state, cut, std::vector<Index>{4}, errors);
    EXPECT_FLOAT_EQ(errors.of_vertex.at(0), 3);
    EXPECT_FLOAT_EQ(errors.all, 3);
  }
}

TEST(VertexErrors, OfANodeThatIsThereTwiceCountOnce) {
  const test::Surface s = test::sheet(4, 5);
  FrameState state = test::patch_state(s, {20, 4});
  for (Index n = 20; n < 24; ++n) state.errors[n] = static_cast<float>(n);
  Cut cut(s.mesh, state.hierarchy, {.level = 1});
  cut.update(s.mesh, state);
  VertexErrors once, twice;
  measure_errors(s.mesh, state, cut, std::vector<Index>{20, 21, 22, 23}, once);
  measure_errors(s.mesh, state, cut, std::vector<Index>{20, 21, 22, 23, 21, 21}, twice);
  EXPECT_EQ(twice.all, once.all);
  EXPECT_EQ(twice.of_vertex.at(5), once.of_vertex.at(1));
}

TEST(VertexErrors, AreNothingWhereThereIsNoAreaAndAtTheFinestLevel) {
  const test::Surface s = test::sheet(4, 5);
  const FrameState state = test::patch_state(s, {20, 4});
  Cut cut(s.mesh, state.hierarchy, {.level = 0});
  cut.update(s.mesh, state);
  std::vector<Index> nodes;
  for (Index v = 0; v < 20; ++v) nodes.push_back(v);
  VertexErrors errors;
  measure_errors(s.mesh, state, cut, nodes, errors);
  EXPECT_EQ(errors.of_vertex, std::vector<float>(20, 0.0f));
  EXPECT_EQ(errors.all, 0.0f);
  measure_errors(s.mesh, state, cut, {}, errors);
  EXPECT_EQ(errors.all, 0.0f);
}

}  // namespace
}  // namespace limber
