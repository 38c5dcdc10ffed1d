// SPDX-License-Identifier: Apache-2.0
//   choose_base_frames(): frames spread over the clip
//   build_four_k(): one structure for all of them
//   the first frame with the structure; each other frame: its errors, its positions     (measure_frame, FourKEncoder)
#include "limber/stream/build_four_k_file.h"

#include <chrono>
#include <vector>

#include "limber/contract/bounds.h"
#include "limber/fourface/creases.h"
#include "limber/fourface/frame_errors.h"
#include "limber/stream/base_frames.h"

namespace limber {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Error cancelled() { return {ErrorCode::kCancelled, "", "interrupted"}; }

Result<BaseFrames> choose_frames(ClipReader& clip, std::uint32_t most, const BuildProgressFunction& progress) {
  Result<BaseFrames> base = choose_base_frames(clip, most, [&](std::uint32_t frames_read) {
    return !progress || progress({BuildStage::kChoosing, frames_read, clip.frame_count()});
  });
  if (!base || base->frame_count > 0) return base;
  // One frame was enough, and it may be all that there is.
  std::vector<Vec3f> positions(clip.mesh().vertex_count);
  for (base->frame_count = 1;; ++base->frame_count) {
    const Result<bool> more = clip.read(positions);
    if (!more) return more.error();
    if (!*more) return base;
  }
}

FourKMesh build_structure(const Mesh& mesh, const BaseFrames& base, const BuildFourKOptions& options,
                          const GoOnFunction& go_on) {
  FourKTags tags;
  if (options.crease_cosine) tags.edges = find_creases(mesh, base.positions.front(), *options.crease_cosine);
  const std::vector<std::span<const Vec3f>> frames(base.positions.begin(), base.positions.end());
  return build_four_k(mesh, frames, options.structure, tags, go_on);
}

}  // namespace

Result<BuildFourKReport> build_four_k_file(ClipReader& clip, const BuildFourKOptions& options, const ByteSink& sink,
                                           const BuildProgressFunction& progress) {
  const auto start = Clock::now();
  Result<BaseFrames> base = choose_frames(clip, options.base_frames, progress);
  if (!base) return base.error();
  const auto building = Clock::now();
  bool goes_on = true;
  const auto go_on = [&] { return goes_on = !progress || progress({BuildStage::kBase, 0, std::nullopt}); };
  FourKMesh mesh = build_structure(clip.mesh(), *base, options, go_on);
  if (!goes_on) return cancelled();

  BuildFourKReport report;
  report.build_seconds = seconds_since(building);
  report.frame_count = base->frame_count;
  report.base_frame_count = static_cast<std::uint32_t>(base->positions.size());
  report.vertex_count = mesh.vertex_count;
  report.finest_count = mesh.finest_count;
  report.operation_count = mesh.operation_count();
  report.level_count = mesh.level_count();
  report.coarsest_count = mesh.triangle_count() - static_cast<Index>(mesh.destroyed.size());
  report.height = height(mesh);

  FourKEncoderOptions encoding = options.encoder;
  encoding.frame_count = base->frame_count;
  encoding.first_frame_number = clip.first_frame_number();
  encoding.frames_per_second = clip.frames_per_second();
  FourKEncoder encoder(sink);
  std::vector<Vec3f> positions = base->positions.front();
  if (Result<void> begun = encoder.begin(bounds(positions), mesh.vertex_count, encoding); !begun) return begun.error();
  if (base->frame_count > 1) measure_frame(mesh, positions, options.structure.quadrics);
  if (Result<void> added = encoder.add_part(mesh, positions); !added) return added.error();
  report.structure_bytes = encoder.byte_count();
  if (Result<void> rewound = clip.rewind(); !rewound) return rewound.error();
  for (std::uint32_t frame = 0; frame < base->frame_count && base->frame_count > 1; ++frame) {
    const Result<bool> more = clip.read(positions);
    if (!more) return more.error();
    if (!*more) return Error{ErrorCode::kMismatch, "", "the clip has fewer frames than when it was first read"};
    if (progress && !progress({BuildStage::kFrames, frame + 1, base->frame_count})) return cancelled();
    if (frame == 0) continue;
    measure_frame(mesh, positions, options.structure.quadrics);
    if (Result<void> added = encoder.add_frame(positions, mesh.error); !added) return added.error();
  }
  if (Result<void> finished = encoder.finish(); !finished) return finished.error();
  report.file_bytes = encoder.byte_count();
  report.total_seconds = seconds_since(start);
  return report;
}

}  // namespace limber
