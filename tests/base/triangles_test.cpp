// SPDX-License-Identifier: Apache-2.0
#include "limber/base/triangles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace limber {
namespace {

using testing::ElementsAre;

TEST(Renumber, CountsCornersInTheOrderInWhichTheyAreMet) {
  std::vector<Triangle> triangles = {{7, 2, 9}, {9, 2, 4}};
  std::vector<Index> vertices = {1, 2, 3}, number;
  renumber(triangles, 10, vertices, number);
  EXPECT_THAT(triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}));
  EXPECT_THAT(vertices, ElementsAre(7, 2, 9, 4));
}

TEST(Renumber, OfNoTrianglesNamesNoVertices) {
  std::vector<Index> vertices = {1}, number;
  renumber({}, 3, vertices, number);
  EXPECT_TRUE(vertices.empty());
}

TEST(ListImages, LeavesOutWhatDegeneratesAndKeepsTheOrder) {
  const std::vector<Triangle> triangles = {{0, 1, 2}, {1, 2, 3}, {3, 2, 0}};
  const std::vector<Index> image_of = {5, 5, 6, 7};
  std::vector<Triangle> out = {{9, 9, 9}};
  list_images(triangles, image_of, out);
  EXPECT_THAT(out, ElementsAre(Triangle{5, 6, 7}, Triangle{7, 6, 5}));
}

}  // namespace
}  // namespace limber
