// SPDX-License-Identifier: Apache-2.0
#include "eval/png.h"

#include <algorithm>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <png.h>
#include <unistd.h>
#include <utility>

namespace limber::eval {
namespace {

void append_bytes(png_structp png, png_bytep data, png_size_t size) {
  auto& bytes = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  const auto* first = reinterpret_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

void flush_nothing(png_structp) {}

void keep_quiet(png_structp, png_const_charp) {}

// Nothing with a destructor may live in this function: libpng reports errors by longjmp.
bool write_rows(png_structp png, png_infop info, const Image& image, bool opaque, png_bytep row) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               opaque ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    png_bytep out = row;
    for (int x = 0; x < image.width; ++x) {
      const Rgba8& p = image.at(x, y);
      *out++ = p.r, *out++ = p.g, *out++ = p.b;
      if (!opaque) *out++ = p.a;
    }
    png_write_row(png, row);
  }
  png_write_end(png, info);
  return true;
}

Error io_error(const std::string& path, const char* what) {
  return {ErrorCode::kIo, path, std::string(what) + ": " + std::strerror(errno)};
}

}  // namespace

Result<std::vector<std::byte>> encode_png(const Image& image) {
  if (image.width < 1 || image.height < 1) {
    return Error{ErrorCode::kBadInput, "", "a picture without pixels cannot be written as PNG"};
  }
  const bool opaque = std::all_of(image.pixels.begin(), image.pixels.end(), [](Rgba8 p) { return p.a == 255; });
  std::vector<std::byte> bytes;
  std::vector<png_byte> row(static_cast<std::size_t>(image.width) * 4);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, keep_quiet);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool written = false;
  if (info != nullptr) {
    png_set_write_fn(png, &bytes, append_bytes, flush_nothing);
    written = write_rows(png, info, image, opaque, row.data());
  }
  png_destroy_write_struct(&png, &info);
  if (!written) return Error{ErrorCode::kBadInput, "", "libpng refused the picture; make it smaller"};
  return bytes;
}

Result<void> write_png(const std::string& path, const Image& image) {
  const Result<std::vector<std::byte>> bytes = encode_png(image);
  if (!bytes) return Error{bytes.error().code, path, bytes.error().what};
  const std::string temporary = path + ".part" + std::to_string(getpid());
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr) return io_error(path, "cannot write here");
  const bool whole = std::fwrite(bytes->data(), 1, bytes->size(), file) == bytes->size();
  const bool closed = std::fclose(file) == 0;
  if (!whole || !closed || std::rename(temporary.c_str(), path.c_str()) != 0) {
    Error error = io_error(path, "cannot write the picture");
    std::remove(temporary.c_str());
    return error;
  }
  return {};
}

}  // namespace limber::eval
