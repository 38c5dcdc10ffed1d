// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/mesh_sequence_reader.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include "limber/clip/input_file.h"
#include "limber/clip/mesh_file.h"

namespace limber {
namespace {

std::string corners_of(const Triangle& t) { return fmt::format("({} {} {})", t[0], t[1], t[2]); }

class MeshSequenceReader final : public ClipReader {
 public:
  MeshSequenceReader(FrameFiles files, MeshFile first)
      : files_(std::move(files)), mesh_(std::move(first.mesh)), positions_(std::move(first.positions)) {}

  const Mesh& mesh() const override { return mesh_; }
  std::optional<std::uint32_t> frame_count() const override { return static_cast<std::uint32_t>(files_.paths.size()); }
  std::uint32_t first_frame_number() const override { return files_.first_number; }

  Result<bool> read(std::span<Vec3f> positions) override {
    assert(positions.size() == mesh_.vertex_count);
    if (next_ == files_.paths.size()) return false;
    // Opening the clip has read the first frame already.
    if (!has_first_) {
      if (Result<void> done = read_file_of(files_.paths[next_]); !done) return done.error();
    }
    has_first_ = false;
    ++next_;
    std::copy(positions_.begin(), positions_.end(), positions.begin());
    return true;
  }

  Result<void> rewind() override {
    if (next_ > 0) has_first_ = false;
    next_ = 0;
    return {};
  }

 private:
  Result<void> read_file_of(const std::filesystem::path& path) {
    if (Result<void> done = read_file(path, bytes_); !done) return done;
    MeshSink sink = MeshSink::comparing(positions_, mesh_.triangles);
    if (Result<void> done = read_mesh(bytes_, path, sink); !done) return done;
    return compare(sink, path);
  }

  Result<void> compare(const MeshSink& sink, const std::filesystem::path& path) const {
    const std::string first = files_.paths.front().filename().string();
    std::string what;
    if (sink.vertex_count() != mesh_.vertex_count || sink.triangle_count() != mesh_.triangles.size()) {
      what = fmt::format("has {} vertices and {} triangles, but the first frame, {}, has {} and {}",
                         sink.vertex_count(), sink.triangle_count(), first, mesh_.vertex_count, mesh_.triangles.size());
    } else if (const auto& difference = sink.difference()) {
      what = fmt::format("triangle {} joins the vertices {}, but in the first frame, {}, {} (numbered from 0)",
                         difference->triangle, corners_of(difference->corners), first,
                         corners_of(mesh_.triangles[difference->triangle]));
    } else {
      return {};
    }
    return Error{ErrorCode::kMismatch, path.string(), what + "; all frames of a clip need the same connectivity"};
  }

  FrameFiles files_;
  Mesh mesh_;
  std::vector<Vec3f> positions_;
  std::string bytes_;
  std::size_t next_ = 0;
  bool has_first_ = true;
};

}  // namespace

Result<std::unique_ptr<ClipReader>> open_mesh_sequence(FrameFiles files) {
  assert(!files.paths.empty());
  Result<MeshFile> first = read_mesh(files.paths.front());
  if (!first) return first.error();
  return std::unique_ptr<ClipReader>(std::make_unique<MeshSequenceReader>(std::move(files), std::move(*first)));
}

}  // namespace limber
