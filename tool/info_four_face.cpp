// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "limber/stream/four_k_decoder.h"
#include "tool/four_face.h"

namespace limber::tool {
namespace {

struct Sums {
  std::uint64_t vertices = 0, finest = 0, coarsest = 0, operations = 0, memory = 0;
  FourKHeight height;                  // of several parts: at most
  std::vector<Index> level_triangles;  // of the only part: after each level
};

Result<Sums> add_up(const FourKDecoder& decoder, const StreamFile& file) {
  Sums sums;
  FourKHeight first, tiles;
  for (std::uint32_t p = 0; p < decoder.part_count(); ++p) {
    const Result<FourKPart> part = decoder.read_part(p);
    if (!part) return in_file(file.name(), part.error());
    const FourKMesh& mesh = part->mesh;
    // The finest triangles of the first part are the coarsest of the others, which share the vertices of their borders.
    if (p > 0 || decoder.part_count() == 1) sums.finest += mesh.finest_count;
    if (decoder.part_count() == 1) sums.vertices = mesh.vertex_count;
    if (p == 0) sums.coarsest = mesh.triangle_count() - mesh.destroyed.size();
    sums.operations += mesh.operation_count();
    sums.memory += mesh.byte_count();
    const FourKHeight high = height(mesh);
    if (p == 0) first = high;
    if (p > 0) tiles = {std::max(tiles.operations, high.operations), std::max(tiles.clusters, high.clusters)};
    if (decoder.part_count() > 1) continue;
    Index left = mesh.finest_count;
    sums.level_triangles.push_back(left);
    for (Index level = 0; level < mesh.level_count(); ++level) {
      for (Index o = mesh.level_begin[level]; o < mesh.level_begin[level + 1]; ++o)
        left -= static_cast<Index>(mesh.destroyed_by(o).size()) - mesh.created_count(o);
      sums.level_triangles.push_back(left);
    }
  }
  sums.height = {first.operations + tiles.operations, first.clusters + tiles.clusters};
  if (decoder.part_count() > 1) sums.vertices = decoder.header().vertex_count;
  return sums;
}

}  // namespace

Result<Exit> info_four_face(const StreamFile& file, Console& console) {
  FourKDecoder decoder;
  if (const Result<void> opened = decoder.open(file.bytes()); !opened) return in_file(file.name(), opened.error());
  const FourKHeader& header = decoder.header();
  const Result<Sums> sums = add_up(decoder, file);
  if (!sums) return sums.error();
  if (!decoder.is_whole()) console.warn("{}: ends early", file.name());
  console.print(
      "{}: four-face file, {} bytes, {:.2f} per vertex\n", one_line(file.name()), file.bytes().size(),
      static_cast<double>(file.bytes().size()) / static_cast<double>(std::max<std::uint64_t>(sums->vertices, 1)));
  console.print("frames      {}, numbered from {}, {:g} per second\n", decoder.frame_count(), header.first_frame_number,
                header.frames_per_second);
  if (decoder.part_count() > 1) console.print("parts       {}\n", decoder.part_count());
  console.print("mesh        {} vertices, {} triangles; coarsest {} triangles\n", sums->vertices, sums->finest,
                sums->coarsest);
  if (!sums->level_triangles.empty())
    console.print("levels      {}: {} triangles\n", sums->level_triangles.size(),
                  fmt::join(sums->level_triangles, " "));
  console.print("operations  {}, {} on the longest chain, {} clusters\n", sums->operations, sums->height.operations,
                sums->height.clusters);
  console.print("memory      {:.1f} bytes per vertex, positions aside\n",
                static_cast<double>(sums->memory) / static_cast<double>(std::max<std::uint64_t>(sums->vertices, 1)));
  console.print("tolerance   {}\n", header.tolerance == 0.0
                                        ? "0: lossless"
                                        : fmt::format("{:.6g} ({:.6g} of the diagonal)", header.tolerance,
                                                      header.tolerance / header.diagonal));
  console.report("limber.info_four_face/1",
                 {{"file", file.name()},
                  {"complete", decoder.is_whole()},
                  {"bytes", file.bytes().size()},
                  {"frames", decoder.frame_count()},
                  {"first_frame", header.first_frame_number},
                  {"parts", decoder.part_count()},
                  {"vertices", sums->vertices},
                  {"triangles", sums->finest},
                  {"coarsest_triangles", sums->coarsest},
                  {"levels", sums->level_triangles},
                  {"operations", sums->operations},
                  {"height", {{"operations", sums->height.operations}, {"clusters", sums->height.clusters}}},
                  {"memory", sums->memory},
                  {"tolerance", header.tolerance},
                  {"diagonal", header.diagonal}});
  return Exit::kDone;
}

}  // namespace limber::tool
