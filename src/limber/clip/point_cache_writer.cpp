// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/point_cache_writer.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "limber/clip/byte_order.h"
#include "limber/clip/mesh_file.h"
#include "limber/clip/output_file.h"

namespace limber {
namespace {

using namespace std::string_view_literals;

constexpr std::endian kLittle = std::endian::little;
constexpr std::endian kBig = std::endian::big;

// What both kinds share: the mesh beside the cache, and frames as bytes.
class PointCacheWriter : public ClipWriter {
 public:
  PointCacheWriter(OutputFile cache, OutputFile mesh_file, const Mesh& mesh, const ClipWriterOptions& options)
      : options_(options),
        cache_(std::move(cache)),
        mesh_file_(std::move(mesh_file)),
        triangles_(mesh.triangles),
        point_count_(mesh.vertex_count) {}

 protected:
  // Appends a frame to `file`; the first one completes the mesh file.
  template <std::endian kOrder>
  Result<void> append(OutputFile& file, std::span<const Vec3f> positions) {
    assert(positions.size() == point_count_);
    if (frame_count_ == 0) {
      if (Result<void> done = write_mesh(mesh_file_, MeshFormat::kObj, {triangles_, positions}); !done) return done;
      if (Result<void> done = mesh_file_.close(); !done) return done;
      triangles_ = {};
    }
    bytes_.resize(kPointSize * positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      char* point = bytes_.data() + kPointSize * i;
      store_float<kOrder>(positions[i].x, point);
      store_float<kOrder>(positions[i].y, point + 4);
      store_float<kOrder>(positions[i].z, point + 8);
    }
    ++frame_count_;
    return file.write(bytes_);
  }

  Result<void> check_not_empty() const {
    if (frame_count_ > 0) return {};
    return Error{ErrorCode::kBadInput, cache_.path().string(), "there are no frames to write"};
  }

  // Both files get their names, or none.
  Result<void> commit() {
    if (Result<void> done = cache_.close(); !done) return done;
    if (Result<void> done = mesh_file_.commit(); !done) return done;
    Result<void> done = cache_.commit();
    if (!done && !options_.replace) {
      std::error_code ignored;
      std::filesystem::remove(mesh_file_.path(), ignored);
    }
    return done;
  }

  ClipWriterOptions options_;
  OutputFile cache_;
  OutputFile mesh_file_;
  std::vector<Triangle> triangles_;
  std::uint32_t point_count_;
  std::uint32_t frame_count_ = 0;
  std::vector<char> bytes_;  // one frame
};

class Pc2Writer final : public PointCacheWriter {
 public:
  using PointCacheWriter::PointCacheWriter;

  Result<void> write(std::span<const Vec3f> positions) override {
    if (frame_count_ == 0) {
      if (Result<void> done = cache_.write(header()); !done) return done;
    }
    return append<kLittle>(cache_, positions);
  }

  Result<void> finish() override {
    if (Result<void> done = check_not_empty(); !done) return done;
    if (Result<void> done = cache_.write_at(0, header()); !done) return done;
    return commit();
  }

 private:
  std::array<char, kPc2HeaderSize> header() const {
    std::array<char, kPc2HeaderSize> header{};
    const std::string_view magic = "POINTCACHE2\0"sv;
    std::copy(magic.begin(), magic.end(), header.begin());
    store<std::uint32_t, kLittle>(1, &header[12]);
    store<std::uint32_t, kLittle>(point_count_, &header[16]);
    store_float<kLittle>(static_cast<float>(options_.first_frame_number), &header[20]);
    store_float<kLittle>(1.0f, &header[24]);
    store<std::uint32_t, kLittle>(frame_count_, &header[28]);
    return header;
  }
};

// The header is as long as the clip, which nobody knows before the last frame: frames wait in a file of their own.
class MddWriter final : public PointCacheWriter {
 public:
  MddWriter(OutputFile frames, OutputFile cache, OutputFile mesh_file, const Mesh& mesh,
            const ClipWriterOptions& options)
      : PointCacheWriter(std::move(cache), std::move(mesh_file), mesh, options), frames_(std::move(frames)) {}

  Result<void> write(std::span<const Vec3f> positions) override { return append<kBig>(frames_, positions); }

  Result<void> finish() override {
    if (Result<void> done = check_not_empty(); !done) return done;
    if (Result<void> done = write_header(); !done) return done;
    constexpr std::uint64_t kBlockSize = 1 << 20;
    for (std::uint64_t offset = 0; offset < frames_.size(); offset += kBlockSize) {
      bytes_.resize(std::min(kBlockSize, frames_.size() - offset));
      if (Result<void> done = frames_.read_at(offset, bytes_); !done) return done;
      if (Result<void> done = cache_.write(bytes_); !done) return done;
    }
    frames_.discard();
    return commit();
  }

 private:
  Result<void> write_header() {
    std::vector<char> header(kMddHeaderSize + 4 * std::size_t{frame_count_});
    store<std::uint32_t, kBig>(frame_count_, &header[0]);
    store<std::uint32_t, kBig>(point_count_, &header[4]);
    for (std::uint32_t i = 0; i < frame_count_; ++i) {
      const double number = static_cast<double>(options_.first_frame_number) + i;
      store_float<kBig>(static_cast<float>(number / options_.frames_per_second),
                        &header[kMddHeaderSize + 4 * std::size_t{i}]);
    }
    return cache_.write(header);
  }

  OutputFile frames_;
};

}  // namespace

Result<std::unique_ptr<ClipWriter>> create_point_cache(const std::filesystem::path& path, PointCacheFormat format,
                                                       const Mesh& mesh, const ClipWriterOptions& options) {
  Result<OutputFile> cache = OutputFile::create(path, options.replace);
  if (!cache) return cache.error();
  Result<OutputFile> mesh_file =
      OutputFile::create(std::filesystem::path(path).replace_extension(".obj"), options.replace);
  if (!mesh_file) return mesh_file.error();
  if (format == PointCacheFormat::kPc2) {
    return std::unique_ptr<ClipWriter>(
        std::make_unique<Pc2Writer>(std::move(*cache), std::move(*mesh_file), mesh, options));
  }
  Result<OutputFile> frames = OutputFile::create(path, options.replace);
  if (!frames) return frames.error();
  return std::unique_ptr<ClipWriter>(
      std::make_unique<MddWriter>(std::move(*frames), std::move(*cache), std::move(*mesh_file), mesh, options));
}

}  // namespace limber
