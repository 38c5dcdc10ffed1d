// SPDX-License-Identifier: Apache-2.0
// A height field that does not fit into memory as a mesh: written to disk row by row, simplified tile by tile into a
// four-face file, and taken out of it with a bound for the triangles or the error.
//
//   example_height_field write 5001 5001 terrain.pgm
//   example_height_field build terrain.pgm terrain.limber
//   example_height_field extract terrain.limber 1000000 terrain.ply
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "limber/clip/mesh_file.h"
#include "limber/clip/output_file.h"
#include "limber/stream/build_height_field.h"
#include "limber/stream/four_k_parts.h"

namespace {

using limber::Index;

// What a grey value of 65,535 stands for, in units of the grid.
constexpr double kHighest = 600;

int fail(const limber::Error& error) {
  std::fprintf(stderr, "%s\n", error.line().c_str());
  return 1;
}

// 0 to 1, the same for the same place.
double random_at(std::uint32_t x, std::uint32_t z, std::uint32_t octave) {
  std::uint32_t h = x * 0x9e3779b1u ^ z * 0x85ebca6bu ^ octave * 0xc2b2ae35u;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  h = (h ^ h >> 12) * 0x297a2d39u;
  return (h ^ h >> 15) / 4294967296.0;
}

double smooth(double t) { return t * t * (3 - 2 * t); }

// Mountains: octaves of smooth noise, the finer ones where it is high.
double height_at(double x, double z) {
  double sum = 0, size = 0.5, weight = 1, cell = 1600;
  for (std::uint32_t octave = 0; octave < 9; ++octave, cell *= 0.5, size *= 0.5) {
    const double gx = x / cell, gz = z / cell;
    const auto ix = static_cast<std::uint32_t>(gx), iz = static_cast<std::uint32_t>(gz);
    const double tx = smooth(gx - ix), tz = smooth(gz - iz);
    const double low = random_at(ix, iz, octave) * (1 - tx) + random_at(ix + 1, iz, octave) * tx;
    const double high = random_at(ix, iz + 1, octave) * (1 - tx) + random_at(ix + 1, iz + 1, octave) * tx;
    const double noise = low * (1 - tz) + high * tz;
    sum += size * weight * noise;
    weight = weight * noise * 1.4 < 1 ? weight * noise * 1.4 : 1;
  }
  return sum < 1 ? sum : 1;
}

// A grey picture of 16 bits (PGM), the higher byte first.
int write(Index width, Index depth, const char* path) {
  std::ofstream file(path, std::ios::binary);
  file << "P5\n" << width << " " << depth << "\n65535\n";
  std::vector<char> row(2 * std::size_t{width});
  for (Index z = 0; z < depth; ++z) {
    for (Index x = 0; x < width; ++x) {
      const auto grey = static_cast<unsigned>(65535 * height_at(x, z));
      row[2 * x] = static_cast<char>(grey >> 8);
      row[2 * x + 1] = static_cast<char>(grey & 0xff);
    }
    file.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
  if (file.flush()) return 0;
  return fail({limber::ErrorCode::kIo, path, "cannot be written"});
}

int build(const char* from, const char* to) {
  std::ifstream file(from, std::ios::binary);
  std::string magic;
  limber::HeightField field;
  unsigned most = 0;
  if (!(file >> magic >> field.width >> field.depth >> most) || magic != "P5" || most != 65535)
    return fail({limber::ErrorCode::kBadInput, from, "is no PGM of 16 bits"});
  const std::streamoff begin = static_cast<std::streamoff>(file.tellg()) + 1;
  field.highest = kHighest;
  std::vector<char> bytes;
  field.read = [&](Index row, Index column, std::span<float> heights) -> limber::Result<void> {
    bytes.resize(2 * heights.size());
    file.seekg(begin + 2 * (static_cast<std::streamoff>(row) * field.width + column));
    if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
      return limber::Error{limber::ErrorCode::kTruncated, from, "ends early"};
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const unsigned grey =
          static_cast<unsigned char>(bytes[2 * i]) * 256u + static_cast<unsigned char>(bytes[2 * i + 1]);
      heights[i] = static_cast<float>(grey * (kHighest / 65535));
    }
    return {};
  };
  auto out = limber::OutputFile::create(to, true);
  if (!out) return fail(out.error());
  const auto sink = [&](std::span<const std::byte> more) {
    return out->write({reinterpret_cast<const char*>(more.data()), more.size()});
  };
  const auto made = limber::build_height_field(field, {}, sink, [](std::uint32_t tiles) {
    std::fprintf(stderr, "\r%u tiles", tiles);
    return true;
  });
  if (!made) return fail(made.error());
  if (const auto committed = out->commit(); !committed) return fail(committed.error());
  std::printf("\n%u tiles, %llu triangles; %u left of the tiles, %u of all; %.2f bytes per vertex\n", made->tile_count,
              static_cast<unsigned long long>(made->finest_count), made->seam_count, made->coarsest_count,
              static_cast<double>(made->file_bytes) / (static_cast<double>(field.width) * field.depth));
  return 0;
}

int extract(const char* from, const char* triangles, const char* to) {
  std::ifstream file(from, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  limber::FourKDecoder decoder;
  if (const auto opened = decoder.open(std::as_bytes(std::span(text))); !opened) return fail(opened.error());
  if (!decoder.is_whole()) return fail({limber::ErrorCode::kTruncated, from, "ends early"});
  const auto error = limber::error_for_size(decoder, std::strtoull(triangles, nullptr, 10));
  if (!error) return fail(error.error());
  const auto mesh = limber::mesh_at_error(decoder, *error);
  if (!mesh) return fail(mesh.error());
  const auto written = limber::write_mesh(
      to, {.triangles = mesh->triangles, .positions = mesh->positions, .normals = {}}, {.replace = true});
  if (!written) return fail(written.error());
  std::printf("%zu triangles, %zu vertices, operations with an error of at most %g\n", mesh->triangles.size(),
              mesh->positions.size(), static_cast<double>(*error));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5 && std::strcmp(argv[1], "write") == 0)
    return write(static_cast<Index>(std::atoi(argv[2])), static_cast<Index>(std::atoi(argv[3])), argv[4]);
  if (argc == 4 && std::strcmp(argv[1], "build") == 0) return build(argv[2], argv[3]);
  if (argc == 5 && std::strcmp(argv[1], "extract") == 0) return extract(argv[2], argv[3], argv[4]);
  std::fprintf(stderr,
               "usage: example_height_field write WIDTH DEPTH OUT.pgm\n"
               "       example_height_field build IN.pgm OUT.limber\n"
               "       example_height_field extract IN.limber TRIANGLES OUT.ply\n");
  return 2;
}
