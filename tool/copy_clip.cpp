// SPDX-License-Identifier: Apache-2.0
#include "tool/copy_clip.h"

#include <vector>

#include "tool/progress.h"

namespace limber::tool {

Result<Exit> copy_clip(ClipReader& reader, const OutputArgument& output, std::string_view schema, Console& console) {
  const Mesh& mesh = reader.mesh();
  auto writer = create_clip(output.path, mesh,
                            {.replace = output.replace,
                             .first_frame_number = reader.first_frame_number(),
                             .frames_per_second = reader.frames_per_second()});
  if (!writer) return writer.error();
  std::vector<Vec3f> positions(mesh.vertex_count);
  Progress progress(console, "writing", reader.frame_count());
  std::uint32_t frame_count = 0;
  for (;;) {
    const Result<bool> more = reader.read(positions);
    if (!more) return more.error();
    if (!*more) break;
    if (Result<void> written = (*writer)->write(positions); !written) return written.error();
    if (!progress.update(++frame_count)) return interruption();
  }
  progress.finish();
  if (Result<void> finished = (*writer)->finish(); !finished) return finished.error();
  console.print("{}: {} frames of {} vertices and {} triangles\n", output.path, frame_count, mesh.vertex_count,
                mesh.triangles.size());
  console.report(schema, {{"output", output.path},
                          {"frames", frame_count},
                          {"first_frame", reader.first_frame_number()},
                          {"vertices", mesh.vertex_count},
                          {"triangles", mesh.triangles.size()}});
  return Exit::kDone;
}

}  // namespace limber::tool
