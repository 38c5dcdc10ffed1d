// SPDX-License-Identifier: Apache-2.0
#include "eval/render.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <tbb/global_control.h>
#include <vector>

#include "eval/normals.h"

namespace limber::eval {
namespace {

// The unit square in the plane z = 0, seen from +z; its lower left corner is vertex 0.
const std::vector<Vec3f> kSquarePositions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
const std::vector<Triangle> kSquare = {{0, 1, 2}, {0, 2, 3}};

// A square of 100 x 100 pixels in the middle of 200 x 200.
const Camera kFrontCamera{.eye = {0, 0, 2}, .target = {}, .up = {0, 1, 0}, .fov_degrees = 90.0};
const RenderOptions kSmallPicture{.width = 200, .height = 200};

struct Bumps {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
};

// An open surface with hollows, folds of depth and a border.
Bumps bumps(int n) {
  Bumps mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float x = 2.0f * static_cast<float>(i) / static_cast<float>(n) - 1.0f;
      const float y = 2.0f * static_cast<float>(j) / static_cast<float>(n) - 1.0f;
      const float u = 3.0f * x - static_cast<float>(static_cast<int>(3.0f * x + 100.0f) - 100);
      mesh.positions.push_back({x, y, 0.8f * u * (1.0f - u) * (1.0f - y * y)});
    }
  }
  const auto at = [n](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

int brightness(Rgba8 p) { return p.r + p.g + p.b; }

TEST(Render, CoversExactlyTheSquareThatTheCameraSees) {
  RenderOptions options = kSmallPicture;
  options.background = kTransparent;
  const Image image = render({kSquare, kSquarePositions}, kFrontCamera, options);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      const bool inside = x >= 50 && x < 150 && y >= 50 && y < 150;
      ASSERT_EQ(image.at(x, y).a, inside ? 255 : 0) << x << ' ' << y;
    }
  }
}

TEST(Render, ShowsPartOfAPixelAsPartOfItsAlpha) {
  RenderOptions options = kSmallPicture;
  options.background = kTransparent;
  std::vector<Vec3f> positions = kSquarePositions;
  for (Vec3f& p : positions) p.x += 0.01f;  // half a pixel
  const Image image = render({kSquare, positions}, kFrontCamera, options);
  EXPECT_NEAR(image.at(50, 100).a, 128, 1);
  EXPECT_NEAR(image.at(150, 100).a, 128, 1);
}

TEST(Render, ShowsTheBackgroundWhereThereIsNoMesh) {
  RenderOptions options = kSmallPicture;
  options.background = {12, 34, 56, 255};
  const Image image = render({{}, {}}, kFrontCamera, options);
  EXPECT_EQ(image, Image(200, 200, options.background));
}

TEST(Render, ShowsTheNearerSquare) {
  const std::vector<Vec3f> positions = {{-1, -1, 0},    {1, -1, 0},    {1, 1, 0},    {-1, 1, 0},
                                        {-1, -1, 0.5f}, {1, -1, 0.5f}, {1, 1, 0.5f}, {-1, 1, 0.5f}};
  const Rgba8 red{220, 20, 20, 255}, blue{20, 20, 220, 255};
  const std::vector<Rgba8> colors = {red, red, red, red, blue, blue, blue, blue};
  for (const std::vector<Triangle>& triangles : {std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}},
                                                 std::vector<Triangle>{{4, 5, 6}, {4, 6, 7}, {0, 1, 2}, {0, 2, 3}}}) {
    const Rgba8 middle =
        render({.triangles = triangles, .positions = positions, .colors = colors}, kFrontCamera, kSmallPicture)
            .at(100, 100);
    EXPECT_GT(middle.b, 2 * middle.r);
  }
}

TEST(Render, DrawsTheWireWhereEdgesAreAndNowhereElse) {
  RenderOptions options = kSmallPicture;
  options.wire_width = 1.5;
  options.occlusion = false;
  const Image plain = render({kSquare, kSquarePositions}, kFrontCamera, kSmallPicture);
  const Image wired = render({kSquare, kSquarePositions}, kFrontCamera, options);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      // The edges: the borders of the square, and the diagonal from its lower left to its upper right.
      const double px = x + 0.5, py = y + 0.5;
      const bool inside = px > 50 && px < 150 && py > 50 && py < 150;
      const double border = std::min({std::abs(px - 50), std::abs(px - 150), std::abs(py - 50), std::abs(py - 150)});
      const double diagonal = std::abs(px + py - 200.0) * std::sqrt(0.5);
      if (inside && std::min(border, diagonal) > 2.5) {
        ASSERT_EQ(wired.at(x, y), plain.at(x, y)) << x << ' ' << y;
      }
      if (inside && std::min(border, diagonal) < 0.6) {
        ASSERT_LT(brightness(wired.at(x, y)), brightness(plain.at(x, y)) * 7 / 10) << x << ' ' << y;
      }
    }
  }
  // The line along the border is drawn over the background as well, in the same strength.
  EXPECT_LT(brightness(wired.at(49, 100)), 500);
  EXPECT_EQ(wired.at(45, 100), kWhite);
}

TEST(Render, HidesTheWireOfWhatIsHidden) {
  // A large plain square before a small one: no edge of the small one shows.
  std::vector<Vec3f> positions = kSquarePositions;
  for (const Vec3f& p : kSquarePositions) positions.push_back({0.3f * p.x, 0.3f * p.y, -0.2f});
  const std::vector<Triangle> both = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  RenderOptions options = kSmallPicture;
  options.wire_width = 1.0;
  options.occlusion = false;
  EXPECT_EQ(render({both, positions}, kFrontCamera, options),
            render({kSquare, kSquarePositions}, kFrontCamera, options));
}

TEST(Render, MapsValuesToColors) {
  RenderOptions options = kSmallPicture;
  options.color_map = ColorMap::kHeat;
  options.low_value = 1.0f;
  options.high_value = 3.0f;
  const auto middle = [&](float value) {
    const std::vector<float> values(4, value);
    return render({.triangles = kSquare, .positions = kSquarePositions, .values = values}, kFrontCamera, options)
        .at(100, 100);
  };
  // Shading scales all three colours alike, in linear light.
  const Rgba8 low = middle(1.0f), half = middle(2.0f), high = middle(3.0f);
  EXPECT_GT(brightness(low), brightness(half));
  EXPECT_GT(brightness(half), brightness(high));
  EXPECT_GT(half.r, 2 * half.b);
  EXPECT_EQ(middle(0.0f), low);
  EXPECT_EQ(middle(9.0f), high);
  const Rgba8 unknown = middle(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(unknown, render({kSquare, kSquarePositions}, kFrontCamera, options).at(100, 100));
}

TEST(Render, ShowsTheBackInAnotherColorButAsBright) {
  const std::vector<Triangle> turned = {{0, 2, 1}, {0, 3, 2}};
  const Rgba8 front = render({kSquare, kSquarePositions}, kFrontCamera, kSmallPicture).at(100, 100);
  const Rgba8 back = render({turned, kSquarePositions}, kFrontCamera, kSmallPicture).at(100, 100);
  EXPECT_GT(front.r, front.b);
  EXPECT_LT(back.r, back.b);
  EXPECT_GT(brightness(back), brightness(front) / 2);
}

TEST(Render, ShadesFlatTrianglesEvenlyAndSmoothOnesNot) {
  // A ridge seen from the front: two squares that meet at an angle.
  const std::vector<Vec3f> positions = {{-1, -1, 0}, {0, -1, 1}, {0, 1, 1}, {-1, 1, 0}, {1, -1, 0}, {1, 1, 0}};
  const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  const Camera camera = frame_camera(bounding_box(triangles, positions), {0, 0, 1}, 1.0);
  RenderOptions options = kSmallPicture;
  options.occlusion = false;
  options.shading = Shading::kFlat;
  const Image flat = render({triangles, positions}, camera, options);
  options.shading = Shading::kSmooth;
  const Image smooth = render({triangles, positions}, camera, options);
  const auto step = [](const Image& image) {
    return std::abs(brightness(image.at(92, 100)) - brightness(image.at(108, 100)));
  };
  EXPECT_GT(step(flat), 30);
  EXPECT_LT(step(smooth), step(flat) / 2);
}

TEST(Render, DarkensHollows) {
  // The floor of an open box against the same floor alone.
  std::vector<Vec3f> positions = kSquarePositions;
  for (const Vec3f& p : kSquarePositions) positions.push_back({p.x, p.y, 1.2f});
  std::vector<Triangle> box = kSquare;
  for (Index k = 0; k < 4; ++k) {
    const Index next = (k + 1) % 4;
    box.push_back({k, next + 4, next});
    box.push_back({k, k + 4, next + 4});
  }
  const Camera camera{.eye = {0, 0, 8}, .target = {}};
  const Rgba8 alone = render({kSquare, positions}, camera, kSmallPicture).at(100, 100);
  const Rgba8 boxed = render({box, positions}, camera, kSmallPicture).at(100, 100);
  EXPECT_LT(brightness(boxed), brightness(alone) * 9 / 10);
}

TEST(Render, CastsAShadowOnTheGroundOnlyWhenAsked) {
  const Bumps mesh = bumps(12);
  const Box box = bounding_box(mesh.triangles, mesh.positions);
  const Camera camera = frame_camera(box, {0.3, 0.5, 1.0}, 1.0, {.margin = 0.25});
  RenderOptions options = kSmallPicture;
  options.background = kTransparent;
  const auto shadow_pixels = [&] {
    const Image image = render({mesh.triangles, mesh.positions}, camera, options);
    return std::count_if(image.pixels.begin(), image.pixels.end(),
                         [](Rgba8 p) { return p.a > 25 && p.a < 230 && p.r < 60; });
  };
  EXPECT_LT(shadow_pixels(), 10);
  options.ground_height = lowest_height(mesh.triangles, mesh.positions, camera.up);
  EXPECT_NEAR(*options.ground_height, -1.0, 1e-6);
  EXPECT_GT(shadow_pixels(), 400);
}

TEST(Render, IsNotDisturbedByDegenerateTrianglesAndUselessNormals) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  RenderOptions options = kSmallPicture;
  options.wire_width = 1.0;
  options.ground_height = -1.0;
  const Image clean = render({kSquare, kSquarePositions}, kFrontCamera, options);
  std::vector<Vec3f> positions = kSquarePositions;
  positions.push_back({nan, 0, 0});
  positions.push_back({0, inf, 0});
  positions.push_back({0, 0, 1e38f});
  std::vector<Triangle> triangles = kSquare;
  triangles.insert(triangles.end(), {{0, 0, 0}, {0, 1, 1}, {0, 1, 4}, {1, 2, 5}, {4, 5, 4}});
  EXPECT_EQ(render({triangles, positions}, kFrontCamera, options), clean);
  const std::vector<Vec3f> normals = {{nan, nan, nan}, {0, 0, 0}, {inf, 0, 0}, {0, 0, 1}};
  const Image odd =
      render({.triangles = kSquare, .positions = kSquarePositions, .normals = normals}, kFrontCamera, options);
  EXPECT_GT(brightness(odd.at(100, 110)), 200);
}

TEST(Render, GivesTheSamePictureForAnyNumberOfThreads) {
  const Bumps mesh = bumps(40);
  const Camera camera = frame_camera(bounding_box(mesh.triangles, mesh.positions), {0.6, 0.5, 1.0}, 1.0);
  RenderOptions options = kSmallPicture;
  options.wire_width = 1.0;
  options.ground_height = -1.0;
  std::vector<Image> images;
  for (const std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    images.push_back(render({mesh.triangles, mesh.positions}, camera, options));
  }
  EXPECT_EQ(images[0], images[1]);
  EXPECT_EQ(images[0], images[2]);
}

TEST(Render, TakesPicturesOfOddSizesAndFromInsideTheMesh) {
  const Bumps mesh = bumps(8);
  for (const int size : {1, 2, 33, 65}) {
    RenderOptions options{.width = size, .height = 67 - size, .wire_width = 1.0};
    const Image image =
        render({mesh.triangles, mesh.positions}, {.eye = {0, 0, 0.05}, .target = {0.3, 0.1, 0}}, options);
    EXPECT_EQ(image.width, size);
  }
}

TEST(VertexNormals, AreThoseOfTheSphereThatTheVerticesLieOn) {
  const std::vector<Vec3f> octahedron = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const std::vector<Triangle> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                           {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  const std::vector<Vec3f> normals = vertex_normals(triangles, octahedron);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(length(normals[i] - octahedron[i]), 0.0f, 1e-6f);
}

}  // namespace
}  // namespace limber::eval
