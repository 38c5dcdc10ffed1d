// SPDX-License-Identifier: Apache-2.0
#include "eval/picture.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "eval/subdivide.h"
#include "tests/eval/shapes.h"

namespace limber::eval {
namespace {

using test::Shape;

PictureOptions small() {
  PictureOptions options;
  options.width = 64, options.height = 48;
  return options;
}

Photographer photographer(const PictureOptions& options, const Surface& surface) {
  PictureBounds bounds;
  bounds.add(surface, options.up);
  return {options, bounds};
}

TEST(Picture, ViewsHaveNamesOrAngles) {
  EXPECT_EQ(parse_view("side"), parse_view("right"));
  EXPECT_EQ(parse_view("-30,12.5"), (View{-30, 12.5}));
  for (const char* const wrong : {"", "behind", "10", "10,", ",10", "10,91", "1,2,3", "nan,0"})
    EXPECT_FALSE(parse_view(wrong)) << wrong;
}

TEST(Picture, ColorsHaveNamesOrCodes) {
  EXPECT_EQ(parse_color("#0a10ff"), (Rgba8{10, 16, 255, 255}));
  EXPECT_EQ(parse_color("transparent")->a, 0);
  for (const char* const wrong : {"", "#12345", "#1234567", "#12345g", "#-12345", "blue"})
    EXPECT_FALSE(parse_color(wrong)) << wrong;
}

TEST(Picture, TheEyeStandsBeforeAboveAndBesideTheSubject) {
  EXPECT_NEAR(length(direction_to_eye({0, 0}, UpAxis::kY) - Vec3d{0, 0, 1}), 0, 1e-12);
  EXPECT_NEAR(length(direction_to_eye({90, 0}, UpAxis::kY) - Vec3d{1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(length(direction_to_eye({0, 0}, UpAxis::kZ) - Vec3d{0, -1, 0}), 0, 1e-12);
  EXPECT_NEAR(length(direction_to_eye({0, 90}, UpAxis::kZ) - Vec3d{0, 0, 1}), 0, 1e-12);
}

TEST(Picture, ShowsTheSubjectOnItsBackground) {
  const Shape sphere = test::sphere(6);
  PictureOptions options = small();
  options.background = {1, 2, 3, 255};
  options.ground = false;
  const Image image = photographer(options, sphere).take(sphere, std::nullopt);
  ASSERT_EQ(image.width, 64);
  EXPECT_EQ(image.at(0, 0), options.background);
  EXPECT_NE(image.at(32, 24), options.background);
}

TEST(Picture, SideBySideHasATileForEachView) {
  const Shape sphere = test::sphere(6), level = test::octahedron();
  PictureOptions options = small();
  options.side_by_side = true;
  const int three = photographer(options, sphere).take(level, sphere).width;
  options.error_colors = true;
  Photographer four = photographer(options, sphere);
  EXPECT_GT(four.take(level, sphere).width, three);
  EXPECT_GT(four.error_range().value(), 0);
}

TEST(Picture, TheRangeOfErrorColorsStaysThatOfTheFirstPicture) {
  const Shape sphere = test::sphere(6);
  PictureOptions options = small();
  options.error_colors = true;
  Photographer camera = photographer(options, sphere);
  camera.take(test::octahedron(), sphere);
  const auto range = camera.error_range();
  camera.take(test::scaled(sphere, 0.25f), sphere);
  EXPECT_EQ(camera.error_range(), range);
}

TEST(Subdivide, KeepsTheSurfaceAndItsOrientation) {
  const Shape octahedron = test::octahedron();
  const Subdivided fine = subdivide(octahedron, octahedron.positions, 3);
  EXPECT_EQ(fine.triangles.size(), 8u * 9);
  EXPECT_EQ(fine.positions.size(), 8u * 10);
  Vec3d before, after;
  for (std::size_t t = 0; t < 9; ++t) after += area_vector(fine, t);
  before = area_vector(octahedron, 0);
  EXPECT_LT(length(after - before), 1e-6);
  for (std::size_t v = 0; v < fine.normals.size(); ++v) EXPECT_LT(length(fine.normals[v] - fine.positions[v]), 1e-6f);
}

}  // namespace
}  // namespace limber::eval
