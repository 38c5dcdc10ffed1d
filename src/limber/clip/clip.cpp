// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/clip.h"

#include <cassert>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "limber/clip/frame_files.h"
#include "limber/clip/frame_range.h"
#include "limber/clip/mesh_file.h"
#include "limber/clip/mesh_sequence_reader.h"
#include "limber/clip/mesh_sequence_writer.h"
#include "limber/clip/numbered_name.h"
#include "limber/clip/point_cache_layout.h"
#include "limber/clip/point_cache_reader.h"
#include "limber/clip/point_cache_writer.h"
#include "limber/clip/sample.h"

namespace limber {
namespace {

namespace fs = std::filesystem;

Result<std::unique_ptr<ClipReader>> open_frames(Result<FrameFiles> files) {
  if (!files) return files.error();
  return open_mesh_sequence(std::move(*files));
}

// A folder with one point cache and no more than its mesh is that cache; otherwise its mesh files are the frames.
Result<std::unique_ptr<ClipReader>> open_folder(const fs::path& folder, const ClipOptions& options) {
  std::vector<fs::path> caches;
  std::size_t mesh_count = 0;
  std::error_code error;
  for (fs::directory_iterator entries(folder, error); !error && entries != fs::directory_iterator();
       entries.increment(error)) {
    const fs::path& path = entries->path();
    if (path.filename().string().starts_with('.')) continue;
    if (point_cache_format(path)) caches.push_back(path);
    if (mesh_format(path)) ++mesh_count;
  }
  if (caches.size() == 1 && mesh_count <= 1) {
    return open_point_cache(caches.front(), *point_cache_format(caches.front()), options);
  }
  if (!caches.empty() && mesh_count <= 1) {
    return Error{ErrorCode::kBadInput, folder.string(), "holds several point caches (.pc2 .mdd); name one of them"};
  }
  return open_frames(frames_of_folder(folder, options));
}

// One mesh file per frame, all of one connectivity.
class MeshClipWriter final : public ClipWriter {
 public:
  MeshClipWriter(MeshSequenceWriter writer, const Mesh& mesh) : writer_(std::move(writer)), mesh_(mesh) {}

  Result<void> write(std::span<const Vec3f> positions) override {
    assert(positions.size() == mesh_.vertex_count);
    return writer_.write({mesh_.triangles, positions});
  }

  Result<void> finish() override { return writer_.finish(); }

 private:
  MeshSequenceWriter writer_;
  Mesh mesh_;
};

Result<std::unique_ptr<ClipReader>> open_every_frame(std::string_view specification, const ClipOptions& options) {
  if (specification.starts_with("sample:")) {
    Result<std::unique_ptr<ClipReader>> sample = open_sample(specification);
    return sample ? limit_frames(std::move(*sample), options, std::string(specification)) : std::move(sample);
  }
  const fs::path path(specification);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return open_folder(path, options);
  if (fs::exists(status)) {
    if (const auto format = point_cache_format(path)) return open_point_cache(path, *format, options);
    if (mesh_format(path)) return open_frames(frames_of_file(path, options));
    return Error{ErrorCode::kUnsupported, path.string(),
                 "is no clip that limber knows; the extensions are .obj .ply .off .pc2 .mdd"};
  }
  const std::string name = path.filename().string();
  if (NumberedName::is_pattern(name)) return open_frames(frames_of_pattern(path, options));
  if (specification.find_first_of("*?") != std::string_view::npos) return open_frames(frames_of_glob(path, options));
  return Error{ErrorCode::kNotFound, path.string(), "no such file or folder"};
}

}  // namespace

Result<std::unique_ptr<ClipReader>> open_clip(std::string_view specification, const ClipOptions& options) {
  assert(options.step >= 1);
  ClipOptions every_frame = options;
  every_frame.step = 1;
  Result<std::unique_ptr<ClipReader>> reader = open_every_frame(specification, every_frame);
  return reader ? every_nth(std::move(*reader), options.step) : std::move(reader);
}

Result<std::unique_ptr<ClipWriter>> create_clip(std::string_view path, const Mesh& mesh,
                                                const ClipWriterOptions& options) {
  if (const auto format = point_cache_format(path)) return create_point_cache(path, *format, mesh, options);
  if (!mesh_format(path)) {
    return Error{ErrorCode::kUnsupported, std::string(path),
                 "is no kind of clip that limber writes; the extensions are .obj .ply .off .pc2 .mdd"};
  }
  Result<MeshSequenceWriter> writer =
      MeshSequenceWriter::create(path, options.first_frame_number, {.replace = options.replace});
  if (!writer) return writer.error();
  return std::unique_ptr<ClipWriter>(std::make_unique<MeshClipWriter>(std::move(*writer), mesh));
}

}  // namespace limber
