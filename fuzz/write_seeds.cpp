// SPDX-License-Identifier: Apache-2.0
// limber_fuzz_seeds FOLDER: writes FOLDER/limber_NAME_fuzzer/..., what each fuzzer starts from, with limber's own
// writers: so that the seeds are always in the format that the readers read.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "limber/clip/clip.h"
#include "limber/clip/mesh_file.h"
#include "limber/clip/sample.h"
#include "limber/stream/build_four_k_file.h"
#include "limber/stream/build_stream.h"

namespace {

using namespace limber;
namespace fs = std::filesystem;
using namespace std::string_literals;

// Two levels at least; an isolated vertex, a degenerate triangle, an edge of three triangles, two components.
const Mesh kAwkward{12, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 5, 6}, {7, 7, 5}, {9, 10, 11}}};

std::vector<Vec3f> awkward_positions(float frame) {
  std::vector<Vec3f> positions;
  for (float i = 0; i < 12; ++i) positions.push_back({i - frame / 3, i * i / 7, frame * i * 0.1f});
  return positions;
}

template <class T>
T must(Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "limber_fuzz_seeds: %s\n", result.error().line().c_str());
  std::exit(1);
}

void must(const Result<void>& result) {
  if (result) return;
  std::fprintf(stderr, "limber_fuzz_seeds: %s\n", result.error().line().c_str());
  std::exit(1);
}

void write(const fs::path& path, const std::string& bytes) {
  fs::create_directories(path.parent_path());
  if (!std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    std::fprintf(stderr, "limber_fuzz_seeds: cannot write %s\n", path.c_str());
    std::exit(1);
  }
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A seed that is refused at once is of no use.
void write_mesh_file(const fs::path& path, char format, const std::string& bytes) {
  MeshFile file;
  MeshSink sink = MeshSink::collecting(file.positions, file.mesh.triangles);
  must(read_mesh(bytes, path, sink));
  write(path, format + bytes);
}

void write_mesh_files(const fs::path& folder, const fs::path& scratch) {
  const std::vector<Vec3f> positions = awkward_positions(1);
  const MeshParts parts{.triangles = kAwkward.triangles, .positions = positions, .normals = positions};
  const char* const names[] = {"a.obj", "a.ply", "a.off"};
  for (int format = 0; format < 3; ++format) {
    must(write_mesh(scratch / names[format], parts, {.replace = true}));
    write_mesh_file(folder / names[format], static_cast<char>(format), bytes_of(scratch / names[format]));
  }
  must(write_mesh(scratch / "text.ply", parts, {.replace = true, .text = true}));
  write_mesh_file(folder / "text.ply", '\1', bytes_of(scratch / "text.ply"));

  // What limber reads but does not write.
  write_mesh_file(
      folder / "polygons.obj", '\0',
      "# a quad\r\no x\nv 0 0 0 1\nv 1e0 0 0\nvt .5 .5\nvn 0 0 1\nv 1 1 0\nv 0 1 0\nf -4/1/1 -3//1 \\\n 3/1 4\n");
  write_mesh_file(folder / "polygons.off", '\2',
                  "CNOFF\n# a quad\n4 1 4\n0 0 0 0 0 1 255 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 0.5\n");
  const std::string header =
      " 1.0\ncomment x\nelement vertex 3\nproperty double x\nproperty short y\nproperty uchar z\n"
      "property list char int more\nelement face 1\nproperty list uchar ushort vertex_indices\nend_header\n";
  write_mesh_file(folder / "polygons.ply", '\1',
                  "ply\nformat ascii" + header + "0 0 0 0\n1 0 0 2 5 6\n0 1 0 0\n3 0 1 2\n");
  std::string big = "ply\nformat binary_big_endian" + header;
  for (int vertex = 0; vertex < 3; ++vertex) big += "\x3f\xf0\0\0\0\0\0\0\0\1\2\1\0\0\0\7"s;
  write_mesh_file(folder / "big_endian.ply", '\1', big + "\3\0\0\0\1\0\2"s);
}

void write_point_caches(const fs::path& folder, const fs::path& scratch) {
  const Mesh mesh{3, {{0, 1, 2}}};
  for (const char* const name : {"a.pc2", "a.mdd"}) {
    const auto cache = must(create_clip((scratch / name).string(), mesh, {.replace = true, .first_frame_number = 7}));
    for (float frame = 0; frame < 3; ++frame) must(cache->write(std::vector<Vec3f>(3, {frame, 1, 2})));
    must(cache->finish());
    write(folder / name, (name[2] == 'p' ? '\0' : '\1') + bytes_of(scratch / name));
  }
}

void write_stream(const fs::path& path, ClipReader& clip, const BuildStreamOptions& options) {
  std::string bytes;
  must(build_stream(clip, options, [&bytes](std::span<const std::byte> more) {
    bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
    return Result<void>();
  }));
  write(path, bytes);
}

void write_streams(const fs::path& folder, const fs::path& scratch) {
  for (const std::string name : {"gallop", "flag"}) {
    const auto clip = must(open_sample("sample:" + name + "?vertices=100&frames=4"));
    write_stream(folder / name, *clip, {.encoder = {.key_interval = 3}});
  }
  const auto frames = must(create_clip((scratch / "%04d.obj").string(), kAwkward, {.replace = true}));
  for (float frame = 0; frame < 4; ++frame) must(frames->write(awkward_positions(frame)));
  must(frames->finish());
  const auto open = [&] { return must(open_clip((scratch / "%04d.obj").string(), {})); };
  BuildStreamOptions options{.hierarchy = {.level_sizes = {6, 4}, .contract = {.topology = Topology::kFree}}};
  write_stream(folder / "awkward", *open(), options);
  options.encoder.lossless = true;
  write_stream(folder / "lossless", *open(), options);
  options.hierarchy = {.branching = 1000};
  write_stream(folder / "one_level", *open(), options);
}

// A stream, and after it what player_fuzzer.cpp does with it: bytes from 0 to 7 begin an action, and say which.
void write_player_inputs(const fs::path& folder, const fs::path& streams) {
  const std::string arriving = "\0\20\0\377\4\4\5\1\50\4\5\3\74\4\0\377"s;
  const std::string in_ranges = "\1\3\3\3\3\3\2\5\3\2\6\5\2\62\7\3\2\4"s;
  for (const std::string name : {"gallop", "flag", "awkward", "one_level"}) {
    int count = 0;
    for (std::string script : {arriving, in_ranges}) {
      script.resize(96, '\5');
      write(folder / (name + std::to_string(count++)), bytes_of(streams / name) + script);
    }
  }
}

void write_four_face_file(const fs::path& path, ClipReader& clip, const BuildFourKOptions& options) {
  std::string bytes;
  must(build_four_k_file(clip, options, [&bytes](std::span<const std::byte> more) {
    bytes.append(reinterpret_cast<const char*>(more.data()), more.size());
    return Result<void>();
  }));
  write(path, bytes);
}

void write_four_face_files(const fs::path& folder) {
  for (const std::string name : {"gallop?vertices=100&frames=4", "flag?vertices=100&frames=1"}) {
    const auto clip = must(open_sample("sample:" + name));
    write_four_face_file(folder / name.substr(0, 4), *clip, {.encoder = {.key_interval = 2}});
  }
  const auto clip = must(open_sample("sample:collapse?vertices=100&frames=3"));
  write_four_face_file(folder / "lossless", *clip, {.encoder = {.lossless = true}});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: limber_fuzz_seeds FOLDER\n");
    return 2;
  }
  const fs::path folder = argv[1], scratch = folder / "scratch";
  fs::create_directories(scratch);
  write_mesh_files(folder / "limber_mesh_file_fuzzer", scratch);
  write_point_caches(folder / "limber_point_cache_fuzzer", scratch);
  write_streams(folder / "limber_stream_fuzzer", scratch);
  write_player_inputs(folder / "limber_player_fuzzer", folder / "limber_stream_fuzzer");
  write_four_face_files(folder / "limber_four_k_fuzzer");
  fs::remove_all(scratch);
  return 0;
}
