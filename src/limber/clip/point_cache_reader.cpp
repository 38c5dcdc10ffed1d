// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/point_cache_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "limber/clip/byte_order.h"
#include "limber/clip/frame_files.h"
#include "limber/clip/mesh_file.h"
#include "limber/clip/numbered_name.h"

namespace limber {
namespace {

namespace fs = std::filesystem;

// Frames [begin, end) of a file.
class PointCacheReader final : public ClipReader {
 public:
  PointCacheReader(InputFile file, const PointCacheLayout& layout, Mesh mesh, std::uint32_t begin, std::uint32_t end)
      : file_(std::move(file)), layout_(layout), mesh_(std::move(mesh)), begin_(begin), end_(end), next_(begin) {}

  const Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint32_t> frame_count() const override { return end_ - begin_; }
  double frames_per_second() const override { return layout_.frames_per_second; }
  std::uint32_t first_frame_number() const override { return layout_.first_frame_number + begin_; }

  Result<bool> read(std::span<Vec3f> positions) override {
    assert(positions.size() == mesh_.vertex_count);
    if (next_ == end_) return false;
    bytes_.resize(layout_.frame_size());
    if (Result<void> done = file_.read(layout_.frame_offset(next_), bytes_); !done) return done.error();
    Result<void> done = layout_.order == std::endian::little ? convert<std::endian::little>(positions)
                                                             : convert<std::endian::big>(positions);
    if (!done) return done.error();
    ++next_;
    return true;
  }

  Result<void> rewind() override {
    next_ = begin_;
    return {};
  }

 private:
  template <std::endian kOrder>
  Result<void> convert(std::span<Vec3f> positions) const {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const char* point = bytes_.data() + kPointSize * i;
      positions[i] = {load_float<kOrder>(point), load_float<kOrder>(point + 4), load_float<kOrder>(point + 8)};
      if (is_finite(positions[i])) continue;
      return Error{
          ErrorCode::kBadInput,
          fmt::format("{}, frame {}, byte {}", file_.name(), next_, layout_.frame_offset(next_) + kPointSize * i),
          fmt::format("the position of vertex {} (counted from 0) is not finite", i)};
    }
    return {};
  }

  InputFile file_;
  PointCacheLayout layout_;
  Mesh mesh_;
  std::uint32_t begin_;
  std::uint32_t end_;
  std::uint32_t next_;
  std::vector<char> bytes_;  // one frame
};

// The mesh file beside the cache.
Result<fs::path> find_mesh(const fs::path& cache) {
  const fs::path folder = cache.parent_path();
  std::vector<std::string> names;
  std::vector<std::string> namesakes;
  std::error_code error;
  fs::directory_iterator entries(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    const std::string name = entries->path().filename().string();
    if (!mesh_format(name) || name.starts_with('.')) continue;
    names.push_back(name);
    if (entries->path().stem() == cache.stem()) namesakes.push_back(name);
  }
  if (error) {
    return Error{ErrorCode::kIo, folder.string(),
                 fmt::format("cannot be searched for the mesh of {}: {}", cache.filename().string(), error.message())};
  }
  if (namesakes.size() == 1) return folder / namesakes.front();
  if (names.size() == 1) return folder / names.front();
  if (names.empty()) {
    return Error{ErrorCode::kNotFound, cache.string(),
                 "a point cache needs its mesh, and no mesh file is beside it; name it with --mesh"};
  }
  std::sort(names.begin(), names.end(), natural_less);
  constexpr std::size_t kListed = 8;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kListed); ++i) list += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kListed) list += fmt::format(" and {} more", names.size() - kListed);
  return Error{ErrorCode::kBadInput, cache.string(),
               fmt::format("several mesh files are beside it ({}); name its mesh with --mesh", list)};
}

}  // namespace

Result<std::unique_ptr<ClipReader>> open_point_cache(const fs::path& path, PointCacheFormat format,
                                                     const ClipOptions& options) {
  Result<InputFile> file = InputFile::open(path);
  if (!file) return file.error();
  const Result<PointCacheLayout> layout = read_point_cache_layout(*file, format);
  if (!layout) return layout.error();
  const std::uint64_t last_number = std::uint64_t{layout->first_frame_number} + layout->frame_count - 1;
  if (Result<void> done = check_range(options, layout->first_frame_number, last_number, path.string()); !done) {
    return done.error();
  }
  fs::path mesh_path = options.mesh;
  if (mesh_path.empty()) {
    Result<fs::path> found = find_mesh(path);
    if (!found) return found.error();
    mesh_path = std::move(*found);
  }
  Result<MeshFile> mesh = read_mesh(mesh_path);
  if (!mesh) return mesh.error();
  if (mesh->mesh.vertex_count != layout->point_count) {
    return Error{ErrorCode::kMismatch, path.string(),
                 fmt::format("moves {} points, but its mesh, {}, has {} vertices; name another with --mesh",
                             layout->point_count, mesh_path.string(), mesh->mesh.vertex_count)};
  }
  const std::uint32_t begin = options.first ? *options.first - layout->first_frame_number : 0;
  const std::uint32_t end = options.last ? *options.last - layout->first_frame_number + 1 : layout->frame_count;
  return std::unique_ptr<ClipReader>(
      std::make_unique<PointCacheReader>(std::move(*file), *layout, std::move(mesh->mesh), begin, end));
}

}  // namespace limber
