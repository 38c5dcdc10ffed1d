// SPDX-License-Identifier: Apache-2.0
// Meshes out of a four-face file of several parts, which is larger than memory: a tile of it is there at a time.
#include <optional>

#include "limber/clip/mesh_sequence_writer.h"
#include "limber/stream/four_k_parts.h"
#include "tool/four_face.h"

namespace limber::tool {
namespace {

void refuse_what_needs_memory(const FourFaceExtract& arguments, const eval::FourFaceRequest& request) {
  if (is_picture(arguments.output.path))
    throw UsageError("a file of several parts is drawn in two steps: extract a mesh, and render that");
  if (request.bend_degrees) throw UsageError("--curvature is for four-face files of one part");
  if (request.front.level && *request.front.level > 0)
    throw UsageError("a file of several parts has no levels beside 0; use --triangles, --vertices or --error");
  if ((request.front.vertices || request.front.triangles) && (request.front.view || request.front.focus))
    throw UsageError("of a file of several parts, --eye and --focus go with --error or --pixels, not with a size");
}

Result<PartsMesh> mesh_of(const FourKDecoder& decoder, const eval::FourFaceRequest& request) {
  const FrontRequest front = front_request(request, decoder.header().diagonal);
  if (front.level) return mesh_at_error(decoder, -1);
  if (!front.vertices && !front.triangles) return mesh_for_request(decoder, front);
  const Result<float> error = front.vertices ? error_for_size(decoder, *front.vertices, FrontBudget::kVertices)
                                             : error_for_size(decoder, *front.triangles);
  if (!error) return error.error();
  return mesh_at_error(decoder, *error);
}

}  // namespace

Result<Exit> extract_parts(const FourFaceExtract& arguments, const eval::FourFaceRequest& request,
                           const StreamFile& file, const FourKDecoder& decoder, Console& console) {
  refuse_what_needs_memory(arguments, request);
  if (!decoder.is_whole())
    return Error{ErrorCode::kTruncated, file.name(), "ends early; a file of several parts is needed whole"};
  const Result<PartsMesh> mesh = mesh_of(decoder, request);
  if (!mesh) return in_file(file.name(), mesh.error());
  if (!arguments.output.path.empty()) {
    auto writer = open_mesh_output(arguments.output, decoder.header().first_frame_number, console);
    if (!writer) return writer.error();
    const Result<void> written =
        writer->write({.triangles = mesh->triangles, .positions = mesh->positions, .normals = {}});
    if (!written) return written.error();
    if (const Result<void> finished = writer->finish(); !finished) return finished.error();
  }
  report_four_face(
      arguments, request,
      {{decoder.header().first_frame_number, mesh->positions.size(), mesh->triangles.size(), std::nullopt}}, console);
  return Exit::kDone;
}

}  // namespace limber::tool
