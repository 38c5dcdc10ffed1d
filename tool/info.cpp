// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <string>
#include <vector>

#include "limber/stream/build_stream.h"
#include "limber/stream/decoder.h"
#include "limber/stream/four_k_decoder.h"
#include "tool/four_face.h"
#include "tool/frame_bytes.h"
#include "tool/progress.h"
#include "tool/stream_file.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

struct Arguments {
  std::string file;
  bool table = false;
};

struct FrameRow {
  bool key = false;
  // Against the frame before, for key frames too:
  std::size_t swap_count = 0;
  std::size_t degenerate_count = 0;  // triangles that are in another degenerate set, or newly in one or in none
  ChunkSizes bytes;
};

// The node in whose degenerate set each triangle is: where two of its corners first meet. kNone: where they never do.
std::vector<Index> degenerate_nodes(const Mesh& mesh, const Hierarchy& hierarchy) {
  std::vector<Index> nodes(mesh.triangles.size(), kNone);
  for (std::size_t t = 0; t < nodes.size(); ++t) {
    auto [a, b, c] = mesh.triangles[t];
    for (Index level = 1; level < hierarchy.level_count() && nodes[t] == kNone; ++level) {
      a = hierarchy.parent[a], b = hierarchy.parent[b], c = hierarchy.parent[c];
      if (a == b || a == c) nodes[t] = a;
      if (b == c) nodes[t] = b;
    }
  }
  return nodes;
}

template <class Values>
std::size_t difference_count(const Values& a, const Values& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1u : 0u;
  return count;
}

// What decoding all frames shows.
Result<std::vector<FrameRow>> read_frames(Decoder& decoder, const StreamFile& file, Console& console) {
  const std::uint32_t count = decoder.available_frames();
  Progress progress(console, "reading", count);
  FrameState state;
  decoder.prepare(state);
  std::vector<Index> parents_before, degenerate_before;
  std::vector<FrameRow> rows;
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    if (Result<void> decoded = decoder.decode(frame, state); !decoded) return in_file(file.name(), decoded.error());
    FrameRow& row = rows.emplace_back();
    row.key = decoder.is_key(frame);
    row.bytes = decoder.sizes(frame);
    std::vector<Index> degenerate = degenerate_nodes(decoder.mesh(), state.hierarchy);
    row.swap_count = difference_count(parents_before, state.hierarchy.parent);
    row.degenerate_count = difference_count(degenerate_before, degenerate);
    parents_before = state.hierarchy.parent;
    degenerate_before = std::move(degenerate);
    if (!progress.update(frame + 1)) return interruption();
  }
  return rows;
}

struct Totals {
  std::uint32_t key_count = 0;
  ChunkSizes bytes;
  Spread swaps, degenerate;
};

Totals add_up(const std::vector<FrameRow>& rows) {
  Totals totals;
  std::vector<double> swaps, degenerate;
  for (const FrameRow& row : rows) {
    totals.key_count += row.key ? 1u : 0u;
    totals.bytes += row.bytes;
    if (&row == rows.data()) continue;
    swaps.push_back(static_cast<double>(row.swap_count));
    degenerate.push_back(static_cast<double>(row.degenerate_count));
  }
  totals.swaps = spread(swaps);
  totals.degenerate = spread(degenerate);
  return totals;
}

std::vector<Index> level_sizes(const StreamHeader& header) {
  std::vector<Index> sizes;
  for (std::size_t level = 1; level < header.level_begin.size(); ++level)
    sizes.push_back(header.level_begin[level] - header.level_begin[level - 1]);
  return sizes;
}

std::string tolerance_text(const StreamHeader& header) {
  if (header.tolerance == 0.0) return "0: lossless";
  return fmt::format("{:.6g} ({:.6g} of the diagonal)", header.tolerance, header.tolerance / header.diagonal);
}

void print(const Decoder& decoder, const StreamFile& file, const std::vector<FrameRow>& rows, bool table,
           Console& console) {
  const StreamHeader& header = decoder.header();
  const auto frame_count = static_cast<std::uint32_t>(rows.size());
  const Totals totals = add_up(rows);
  const std::vector<Index> sizes = level_sizes(header);
  console.print("{}: stream version {}, {} bytes\n", one_line(file.name()), header.version, file.bytes().size());
  console.print("frames     {}, numbered from {}, {:g} per second, {} of them keys\n", frame_count,
                header.first_frame_number, header.frames_per_second, totals.key_count);
  console.print("mesh       {} vertices, {} triangles\n", sizes.front(), decoder.mesh().triangles.size());
  console.print("levels     {}: {}{}\n", sizes.size(), fmt::join(sizes, " "),
                header.manifold_kept ? "; all homeomorphic" : "");
  console.print("swaps      {:.1f} per frame (95th percentile {:.0f}); {:.1f} triangles change their degenerate set\n",
                totals.swaps.mean, totals.swaps.p95, totals.degenerate.mean);
  console.print("bytes      {}\n", frame_bytes_line(totals.bytes, frame_count));
  console.print("bits       {:.2f} per vertex and frame; raw positions take 96\n",
                bits_per_vertex(file.bytes().size(), sizes.front(), frame_count));
  console.print("tolerance  {}\n", tolerance_text(header));
  if (!table) return;
  console.print("\n{:>8} {:>4} {:>8} {:>10} {:>10} {:>10} {:>8} {:>10}\n", "frame", "key", "swaps", "hierarchy",
                "finest", "coarser", "errors", "bytes");
  for (std::uint32_t i = 0; i < frame_count; ++i) {
    const FrameRow& row = rows[i];
    console.print("{:>8} {:>4} {:>8} {:>10} {:>10} {:>10} {:>8} {:>10}\n", header.first_frame_number + i,
                  row.key ? "key" : "", row.swap_count, row.bytes.hierarchy, row.bytes.finest_positions,
                  row.bytes.coarser_positions, row.bytes.errors, row.bytes.total());
  }
}

Json to_json(const Decoder& decoder, const StreamFile& file, const std::vector<FrameRow>& rows, bool table) {
  const StreamHeader& header = decoder.header();
  const auto frame_count = static_cast<std::uint32_t>(rows.size());
  const Totals totals = add_up(rows);
  const std::vector<Index> sizes = level_sizes(header);
  Json json = {{"file", file.name()},
               {"version", header.version},
               {"complete", decoder.frame_count() == frame_count},
               {"bytes", file.bytes().size()},
               {"frames", frame_count},
               {"first_frame", header.first_frame_number},
               {"frames_per_second", header.frames_per_second},
               {"keys", totals.key_count},
               {"key_interval", header.key_interval},
               {"vertices", sizes.front()},
               {"triangles", decoder.mesh().triangles.size()},
               {"levels", sizes},
               {"manifold_kept", header.manifold_kept},
               {"swaps", {{"mean", totals.swaps.mean}, {"p95", totals.swaps.p95}}},
               {"degenerate_changes", {{"mean", totals.degenerate.mean}, {"p95", totals.degenerate.p95}}},
               {"bytes_per_frame", frame_bytes_json(totals.bytes, frame_count)},
               {"bits_per_vertex_and_frame", bits_per_vertex(file.bytes().size(), sizes.front(), frame_count)},
               {"lossless", header.tolerance == 0.0},
               {"tolerance", header.tolerance},
               {"diagonal", header.diagonal}};
  if (!table) return json;
  Json& list = json["frame_table"] = Json::array();
  for (std::uint32_t i = 0; i < frame_count; ++i) {
    list.push_back({{"frame", header.first_frame_number + i},
                    {"key", rows[i].key},
                    {"swaps", rows[i].swap_count},
                    {"degenerate_changes", rows[i].degenerate_count},
                    {"hierarchy", rows[i].bytes.hierarchy},
                    {"finest_positions", rows[i].bytes.finest_positions},
                    {"coarser_positions", rows[i].bytes.coarser_positions},
                    {"errors", rows[i].bytes.errors},
                    {"bytes", rows[i].bytes.total()}});
  }
  return json;
}

Result<Exit> info(const Arguments& arguments, Console& console) {
  const Result<StreamFile> file = StreamFile::open(arguments.file);
  if (!file) return file.error();
  if (is_four_face_file(file->bytes())) return info_four_face(*file, console);
  Result<Decoder> decoder = open_decoder(*file);
  if (!decoder) return decoder.error();
  const Result<std::vector<FrameRow>> rows = read_frames(*decoder, *file, console);
  if (!rows) return rows.error();
  if (decoder->frame_count() != rows->size()) {
    const auto all = decoder->frame_count();
    console.warn("{}: ends early: {} whole frames{}", file->name(), rows->size(),
                 all ? fmt::format(" of {}", *all) : "");
  }
  print(*decoder, *file, *rows, arguments.table, console);
  console.report("limber.info/1", to_json(*decoder, *file, *rows, arguments.table));
  return Exit::kDone;
}

}  // namespace

Action declare_info(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file, "a stream; - for standard input")->required();
  app.add_flag("--frames", arguments->table, "a line for every frame, too");
  return [arguments](Console& console) { return info(*arguments, console); };
}

}  // namespace limber::tool
