// SPDX-License-Identifier: Apache-2.0
#include "tool/take_pictures.h"

#include "eval/png.h"
#include "limber/clip/output_sequence.h"
#include "tool/progress.h"

namespace limber::tool {
namespace {

Result<eval::PictureBounds> find_bounds(const PictureJob& job, Progress& progress) {
  auto source = job.open_space();
  if (!source) return source.error();
  progress.start("looking", (*source)->frame_count());
  eval::PictureBounds bounds;
  eval::SourceMesh mesh;
  for (std::uint32_t done = 0;;) {
    const Result<bool> more = (*source)->read(mesh);
    if (!more) return more.error();
    if (!*more) return bounds;
    bounds.add({mesh.triangles, mesh.positions}, job.options.up);
    if (!progress.update(++done)) return interruption();
  }
}

Result<void> write_picture(const eval::Image& image, OutputSequence& files) {
  const Result<std::vector<std::byte>> bytes = eval::encode_png(image);
  if (!bytes) return bytes.error();
  const Result<OutputFile*> file = files.next();
  if (!file) return file.error();
  return (*file)->write({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
}

}  // namespace

Result<TakenPictures> take_pictures(const PictureJob& job, const OutputArgument& output, Console& console) {
  auto level = job.open_level();
  if (!level) return level.error();
  std::unique_ptr<eval::MeshSource> original;
  if (job.options.error_colors || job.options.side_by_side) {
    auto opened = job.open_original();
    if (!opened) return opened.error();
    original = std::move(*opened);
  }
  // Before the work, so that an output that is in the way is found out at once.
  Result<OutputSequence> files = OutputSequence::create(output.path, (*level)->first_frame_number(), output.replace);
  if (!files) return files.error();

  Progress progress(console, "looking");
  const Result<eval::PictureBounds> bounds = find_bounds(job, progress);
  if (!bounds) return bounds.error();
  eval::Photographer photographer =
      job.camera ? eval::Photographer(job.options, *job.camera) : eval::Photographer(job.options, *bounds);
  progress.start("rendering", (*level)->frame_count());
  TakenPictures taken;
  eval::SourceMesh mesh, original_mesh;
  for (;;) {
    const Result<bool> more = (*level)->read(mesh);
    if (!more) return more.error();
    if (!*more) break;
    const eval::Surface surface{mesh.triangles, mesh.positions};
    const auto done = static_cast<std::uint32_t>(taken.frames.size());
    const std::uint32_t number = (*level)->first_frame_number() + done;
    std::optional<eval::Surface> original_surface;
    if (original) {
      const Result<bool> found = original->read(original_mesh);
      if (!found) return found.error();
      if (!*found) {
        return Error{ErrorCode::kMismatch, "",
                     fmt::format("the original has {} frames only, and there is more to show", done)};
      }
      original_surface = {original_mesh.triangles, original_mesh.positions};
      if (job.options.error_colors && (surface.triangles.empty() || original_surface->triangles.empty())) {
        return Error{ErrorCode::kBadInput, fmt::format("frame {}", number),
                     "has no triangles, and so no distances to show"};
      }
    }
    if (Result<void> written = write_picture(photographer.take(surface, original_surface), *files); !written)
      return written.error();
    taken.frames.push_back({number, used_vertex_count(surface), static_cast<Index>(mesh.triangles.size())});
    if (!progress.update(taken.frames.size())) return interruption();
  }
  progress.finish();
  if (Result<void> finished = files->finish(); !finished) return finished.error();
  taken.error_range = photographer.error_range();
  return taken;
}

}  // namespace limber::tool
