// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tool/four_face.h"
#include "tool/frame_bytes.h"
#include "tool/progress.h"

namespace limber::tool {

Result<void> build_four_face(ClipReader& clip, const BuildFourKOptions& options, const ByteSink& sink,
                             const std::string& output, Console& console) {
  Progress progress(console, "reading");
  BuildStage stage = BuildStage::kChoosing;
  const Result<BuildFourKReport> made = build_four_k_file(clip, options, sink, [&](const BuildProgress& now) {
    if (now.stage != stage) progress.start(now.stage == BuildStage::kBase ? "building" : "encoding", now.frame_count);
    stage = now.stage;
    return progress.update(now.frames_done);
  });
  if (!made) return made.error();
  progress.finish();
  const BuildFourKReport& r = *made;
  const double logarithm = r.finest_count > 1 ? std::log2(r.finest_count) : 1;
  console.print("{}: four-face, {} frames, {} vertices, {} triangles; {} bytes\n", output, r.frame_count,
                r.vertex_count, r.finest_count, r.file_bytes);
  console.print("operations    {} in {} levels, down to {} triangles; structure made for {} frames\n",
                r.operation_count, r.level_count, r.coarsest_count, r.base_frame_count);
  console.print("height        {} operations, {} clusters: {:.2f} and {:.2f} times log2 of the triangles\n",
                r.height.operations, r.height.clusters, r.height.operations / logarithm, r.height.clusters / logarithm);
  console.print("bytes         {:.2f} per vertex for the structure and its first frame{}\n",
                static_cast<double>(r.structure_bytes) / std::max<Index>(r.vertex_count, 1),
                r.frame_count < 2 ? ""
                                  : fmt::format("; {:.2f} bits per vertex and other frame",
                                                bits_per_vertex(r.file_bytes - r.structure_bytes, r.vertex_count,
                                                                r.frame_count - 1)));
  console.print("seconds       {:.2f}, of which the structure {:.2f}\n", r.total_seconds, r.build_seconds);
  console.report("limber.build_four_face/1",
                 {{"output", output},
                  {"frames", r.frame_count},
                  {"vertices", r.vertex_count},
                  {"triangles", r.finest_count},
                  {"coarsest_triangles", r.coarsest_count},
                  {"operations", r.operation_count},
                  {"levels", r.level_count},
                  {"height", {{"operations", r.height.operations}, {"clusters", r.height.clusters}}},
                  {"bytes", r.file_bytes},
                  {"structure_bytes", r.structure_bytes},
                  {"seconds", {{"structure", r.build_seconds}, {"total", r.total_seconds}}}});
  return {};
}

}  // namespace limber::tool
