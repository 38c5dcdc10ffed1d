// SPDX-License-Identifier: Apache-2.0
#include "eval/mesh_source.h"

#include <cassert>
#include <filesystem>
#include <numeric>
#include <system_error>
#include <utility>

#include "eval/stream_levels.h"
#include "limber/clip/frame_files.h"
#include "limber/clip/mesh_file.h"
#include "limber/clip/numbered_name.h"

namespace limber::eval {
namespace {

namespace fs = std::filesystem;

class FileMeshes final : public MeshSource {
 public:
  explicit FileMeshes(FrameFiles files) : files_(std::move(files)) {}

  std::optional<std::uint32_t> frame_count() const override { return static_cast<std::uint32_t>(files_.paths.size()); }
  std::uint32_t first_frame_number() const override { return files_.first_number; }

  Result<bool> read(SourceMesh& mesh) override {
    if (next_ == files_.paths.size()) return false;
    Result<MeshFile> file = read_mesh(files_.paths[next_++]);
    if (!file) return file.error();
    mesh = {std::move(file->mesh.triangles), std::move(file->positions), {}};
    return true;
  }

 private:
  FrameFiles files_;
  std::size_t next_ = 0;
};

class ClipMeshes final : public MeshSource {
 public:
  explicit ClipMeshes(std::unique_ptr<ClipReader> clip) : clip_(std::move(clip)) {}

  std::optional<std::uint32_t> frame_count() const override { return clip_->frame_count(); }
  std::uint32_t first_frame_number() const override { return clip_->first_frame_number(); }

  Result<bool> read(SourceMesh& mesh) override {
    positions_.resize(clip_->mesh().vertex_count);
    const Result<bool> more = clip_->read(positions_);
    if (!more || !*more) return more;
    mesh.triangles = clip_->mesh().triangles;
    mesh.positions = positions_;
    mesh.nodes.resize(positions_.size());
    std::iota(mesh.nodes.begin(), mesh.nodes.end(), Index{0});
    return true;
  }

 private:
  std::unique_ptr<ClipReader> clip_;
  std::vector<Vec3f> positions_;
};

class StreamMeshes final : public MeshSource {
 public:
  StreamMeshes(std::unique_ptr<StreamLevels> levels, std::uint32_t first, std::uint32_t end, std::uint32_t step)
      : levels_(std::move(levels)), first_(first), end_(end), step_(step), next_(first) {}

  std::optional<std::uint32_t> frame_count() const override { return (end_ - first_ + step_ - 1) / step_; }
  std::uint32_t first_frame_number() const override { return levels_->first_frame_number() + first_; }

  Result<bool> read(SourceMesh& mesh) override {
    if (next_ >= end_) return false;
    if (const Result<void> there = levels_->go_to(static_cast<std::uint32_t>(next_)); !there) return there.error();
    next_ += step_;
    const MeshBuffers& buffers = levels_->buffers();
    mesh.positions = buffers.positions;
    mesh.nodes = buffers.nodes;
    mesh.triangles.resize(buffers.triangle_count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) mesh.triangles[t][k] = buffers.indices[3 * t + k];
    }
    return true;
  }

 private:
  std::unique_ptr<StreamLevels> levels_;
  std::uint32_t first_, end_, step_;  // frames, counted from 0
  std::uint64_t next_;
};

// The mesh files that the specification names; nothing where it is for open_clip() to say what it is.
std::optional<Result<FrameFiles>> find_files(std::string_view specification, const ClipOptions& options) {
  const fs::path path(specification);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    // A folder with a single mesh may be that of a point cache.
    Result<FrameFiles> files = frames_of_folder(path, options);
    if (files && files->paths.size() == 1 && !options.first && !options.last && options.step == 1) return std::nullopt;
    if (!files && files.error().code == ErrorCode::kNotFound) return std::nullopt;
    return files;
  }
  if (fs::exists(status)) {
    if (!mesh_format(path)) return std::nullopt;
    return frames_of_file(path, options);
  }
  if (NumberedName::is_pattern(path.filename().string())) return frames_of_pattern(path, options);
  if (specification.find_first_of("*?") != std::string_view::npos && !specification.starts_with("sample:")) {
    return frames_of_glob(path, options);
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<MeshSource> meshes_of(std::unique_ptr<ClipReader> clip) {
  assert(clip);
  return std::make_unique<ClipMeshes>(std::move(clip));
}

Result<std::unique_ptr<MeshSource>> open_meshes(std::string_view specification, const ClipOptions& options) {
  if (std::optional<Result<FrameFiles>> files = find_files(specification, options)) {
    if (!*files) return files->error();
    return std::unique_ptr<MeshSource>(std::make_unique<FileMeshes>(std::move(**files)));
  }
  Result<std::unique_ptr<ClipReader>> clip = open_clip(specification, options);
  if (!clip) return clip.error();
  return meshes_of(std::move(*clip));
}

Result<std::unique_ptr<MeshSource>> open_stream_meshes(std::string_view path, const LevelChoice& level,
                                                       const ClipOptions& options) {
  Result<std::unique_ptr<StreamLevels>> levels = StreamLevels::open(fs::path(path));
  if (!levels) return levels.error();
  (*levels)->choose(level);
  const std::uint32_t low = (*levels)->first_frame_number();
  const std::uint64_t high = std::uint64_t{low} + (*levels)->available_frames() - 1;
  if (const Result<void> fits = check_range(options, low, high, std::string(path)); !fits) return fits.error();
  const std::uint32_t first = options.first.value_or(low) - low;
  const auto end = static_cast<std::uint32_t>(options.last.value_or(high) - low + 1);
  return std::unique_ptr<MeshSource>(std::make_unique<StreamMeshes>(std::move(*levels), first, end, options.step));
}

}  // namespace limber::eval
