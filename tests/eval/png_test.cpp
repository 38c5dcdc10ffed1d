// SPDX-License-Identifier: Apache-2.0
#include "eval/png.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <png.h>

namespace limber::eval {
namespace {

Image read_png(const std::vector<std::byte>& bytes) {
  png_image reader{};
  reader.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size())) return {};
  reader.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(reader.width), static_cast<int>(reader.height), kWhite);
  if (!png_image_finish_read(&reader, nullptr, image.pixels.data(), 0, nullptr)) return {};
  return image;
}

std::vector<std::byte> bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> chars((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto* first = reinterpret_cast<const std::byte*>(chars.data());
  return {first, first + chars.size()};
}

// All channels take many values; alpha only where asked for.
Image pattern(bool opaque) {
  Image image(37, 21, kWhite);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto code = [](int v) { return static_cast<std::uint8_t>(v % 256); };
      image.at(x, y) = {code(x * 7), code(y * 12), code(x * y), opaque ? std::uint8_t{255} : code(x * 6 + y)};
    }
  }
  return image;
}

TEST(EncodePng, GivesBackEveryPixelWithAndWithoutAlpha) {
  for (const bool opaque : {true, false}) {
    const Image image = pattern(opaque);
    const auto bytes = encode_png(image);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(read_png(*bytes), image);
    EXPECT_EQ(*bytes, *encode_png(image));
  }
}

TEST(EncodePng, RefusesAPictureWithoutPixels) { EXPECT_FALSE(encode_png(Image{})); }

TEST(WritePng, ReplacesTheFileAndLeavesNothingBeside) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "limber_write_png";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::filesystem::path path = folder / "picture.png";
  ASSERT_TRUE(write_png(path.string(), Image(3, 3, kWhite)));
  const Image image = pattern(true);
  ASSERT_TRUE(write_png(path.string(), image));
  EXPECT_EQ(read_png(bytes_of(path)), image);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

TEST(WritePng, NamesTheFileThatItCannotWrite) {
  const std::string path = testing::TempDir() + "/no such folder/picture.png";
  const Result<void> written = write_png(path, Image(3, 3, kWhite));
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kIo);
  EXPECT_EQ(written.error().where, path);
}

}  // namespace
}  // namespace limber::eval
