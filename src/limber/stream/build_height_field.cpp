// SPDX-License-Identifier: Apache-2.0
//   for each tile
//     its vertices and triangles; a 4-K mesh of it, its border kept     (read_tile, border_of)
//     coded as a part; what is left of it goes to the whole             (Whole::add)
//   a 4-K mesh of the whole; its errors, not below those of the tiles   (Whole::raise)
//   coded as the first part
#include "limber/stream/build_height_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace limber {
namespace {

Error cancelled() { return {ErrorCode::kCancelled, "", "interrupted"}; }

struct Tile {
  Mesh mesh;
  std::vector<Vec3f> positions;
  std::vector<Index> numbers;  // in the field
};

// The vertices of rows `row` to `last_row`, columns `column` to `last_column`.
Result<Tile> read_tile(const HeightField& field, Index row, Index last_row, Index column, Index last_column) {
  Tile tile;
  const Index width = last_column - column + 1;
  std::vector<float> heights(width);
  for (Index z = row; z <= last_row; ++z) {
    if (Result<void> read = field.read(z, column, heights); !read) return read.error();
    for (Index i = 0; i < width; ++i) {
      tile.positions.push_back({static_cast<float>(column + i), heights[i], static_cast<float>(z)});
      tile.numbers.push_back(z * field.width + column + i);
    }
  }
  tile.mesh.vertex_count = static_cast<Index>(tile.positions.size());
  for (Index z = 0; z < last_row - row; ++z) {
    for (Index x = 0; x + 1 < width; ++x) {
      const Index a = z * width + x, b = a + 1, c = a + width, d = c + 1;
      tile.mesh.triangles.push_back({a, c, b});
      tile.mesh.triangles.push_back({b, c, d});
    }
  }
  return tile;
}

std::vector<Index> border_of(const Tile& tile, Index width) {
  std::vector<Index> border;
  for (Index v = 0; v < tile.mesh.vertex_count; ++v)
    if (v % width == 0 || v % width + 1 == width || v < width || v + width >= tile.mesh.vertex_count)
      border.push_back(v);
  return border;
}

// What is left of the tiles, as one mesh.
class Whole {
 public:
  explicit Whole(Index field_size) : place_(field_size, kNone) {}

  void add(const Tile& tile, const FourKMesh& mesh) {
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.destroyer[t] != kNone) continue;
      Triangle corners = mesh.triangles[t];
      for (Index& corner : corners) corner = place_of(tile, corner);
      joined_.triangles.push_back(corners);
      const Index creator = mesh.creator[t];
      floors_.push_back({begun_with_least(corners), creator == kNone ? 0 : mesh.error[creator]});
    }
    joined_.vertex_count = static_cast<Index>(positions_.size());
  }

  FourKMesh build(unsigned threads) {
    place_ = {};
    FourKMesh made = build_four_k(joined_, positions_, {.threads = threads});
    raise(made);
    return made;
  }

  const std::vector<Vec3f>& positions() const { return positions_; }
  const std::vector<Index>& numbers() const { return numbers_; }
  Index triangle_count() const { return static_cast<Index>(joined_.triangles.size()); }

 private:
  static Triangle begun_with_least(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  }

  Index place_of(const Tile& tile, Index v) {
    Index& place = place_[tile.numbers[v]];
    if (place == kNone) {
      place = static_cast<Index>(positions_.size());
      positions_.push_back(tile.positions[v]);
      numbers_.push_back(tile.numbers[v]);
    }
    return place;
  }

  // An operation's error is at least that of the tile's operations that have created what it destroys.
  void raise(FourKMesh& mesh) {
    std::sort(floors_.begin(), floors_.end());
    for (Index o = 0; o < mesh.operation_count(); ++o) {
      for (const Index t : mesh.destroyed_by(o)) {
        if (const Index creator = mesh.creator[t]; creator != kNone) {
          mesh.error[o] = std::max(mesh.error[o], mesh.error[creator]);
          continue;
        }
        const Triangle corners = begun_with_least(mesh.triangles[t]);
        const auto found = std::lower_bound(floors_.begin(), floors_.end(), std::pair(corners, 0.0f));
        if (found != floors_.end() && found->first == corners) mesh.error[o] = std::max(mesh.error[o], found->second);
      }
    }
  }

  std::vector<Index> place_;  // [field size]
  Mesh joined_;
  std::vector<Vec3f> positions_;
  std::vector<Index> numbers_;
  std::vector<std::pair<Triangle, float>> floors_;
};

}  // namespace

Result<HeightFieldReport> build_height_field(const HeightField& field, const HeightFieldOptions& options,
                                             const ByteSink& sink, const std::function<bool(std::uint32_t)>& go_on) {
  assert(field.width >= 2 && field.depth >= 2 && options.tile >= 2);
  const Index across = (field.width - 2) / options.tile + 1, down = (field.depth - 2) / options.tile + 1;
  HeightFieldReport report;
  report.tile_count = across * down;
  FourKEncoder encoder(sink);
  Box box;
  box.add({0, field.lowest, 0});
  box.add({static_cast<double>(field.width - 1), field.highest, static_cast<double>(field.depth - 1)});
  const Result<void> begun =
      encoder.begin(box, field.width * field.depth,
                    {.tolerance = options.tolerance, .part_count = report.tile_count + 1, .first_part_last = true});
  if (!begun) return begun.error();

  Whole whole(field.width * field.depth);
  for (Index i = 0; i < report.tile_count; ++i) {
    const Index row = i / across * options.tile, column = i % across * options.tile;
    const Index last_column = std::min(column + options.tile, field.width - 1);
    const Result<Tile> tile = read_tile(field, row, std::min(row + options.tile, field.depth - 1), column, last_column);
    if (!tile) return tile.error();
    const auto triangles = static_cast<double>(tile->mesh.triangles.size());
    const FourKMesh made = build_four_k(
        tile->mesh, tile->positions,
        {.triangles = static_cast<Index>(std::floor(options.tile_share * triangles)), .threads = options.threads},
        {.vertices = border_of(*tile, last_column - column + 1), .edges = {}});
    if (Result<void> added = encoder.add_part(made, tile->positions, tile->numbers); !added) return added.error();
    whole.add(*tile, made);
    report.finest_count += made.finest_count;
    report.operation_count += made.operation_count();
    if (go_on && !go_on(i + 1)) return cancelled();
  }

  const FourKMesh joined = whole.build(options.threads);
  report.seam_count = whole.triangle_count();
  report.coarsest_count = joined.triangle_count() - static_cast<Index>(joined.destroyed.size());
  report.operation_count += joined.operation_count();
  if (Result<void> added = encoder.add_part(joined, whole.positions(), whole.numbers()); !added) return added.error();
  if (Result<void> finished = encoder.finish(); !finished) return finished.error();
  report.file_bytes = encoder.byte_count();
  return report;
}

}  // namespace limber
