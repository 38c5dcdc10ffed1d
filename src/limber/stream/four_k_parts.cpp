// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/four_k_parts.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "limber/stream/error_coding.h"

namespace limber {
namespace {

Triangle begun_with_least(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

// Whether a triangle is there when the operations with at most this error are applied.
bool is_left(const FourKMesh& mesh, Index t, float error) {
  const Index creator = mesh.creator[t], destroyer = mesh.destroyer[t];
  return (creator == kNone || mesh.error[creator] <= error) &&
         (destroyer == kNone || !(mesh.error[destroyer] <= error));
}

struct Corner {
  Index number;
  Vec3f position;
};

class Gathered {
 public:
  void add(const FourKPart& part, Index t) {
    Triangle corners = part.mesh.triangles[t];
    for (Index& corner : corners) {
      corners_.push_back({part.numbers[corner], part.positions[corner]});
      corner = part.numbers[corner];
    }
    mesh_.triangles.push_back(corners);
  }
  // After each part, so that there is no more than a part's corners beside those that differ.
  void settle() {
    std::sort(corners_.begin(), corners_.end(), [](const Corner& a, const Corner& b) { return a.number < b.number; });
    corners_.erase(std::unique(corners_.begin(), corners_.end(),
                               [](const Corner& a, const Corner& b) { return a.number == b.number; }),
                   corners_.end());
    for (const Corner& corner : corners_) all_.push_back(corner);
    corners_.clear();
  }
  PartsMesh take() && {
    corners_ = std::exchange(all_, {});
    settle();
    for (const Corner& corner : all_) {
      mesh_.numbers.push_back(corner.number);
      mesh_.positions.push_back(corner.position);
    }
    for (Triangle& t : mesh_.triangles)
      for (Index& corner : t)
        corner = static_cast<Index>(std::lower_bound(mesh_.numbers.begin(), mesh_.numbers.end(), corner) -
                                    mesh_.numbers.begin());
    return std::move(mesh_);
  }

 private:
  PartsMesh mesh_;
  std::vector<Corner> corners_, all_;
};

}  // namespace

Result<float> error_for_triangles(const FourKDecoder& decoder, std::uint64_t triangles) {
  assert(decoder.is_whole());
  std::array<std::uint64_t, kLargestError + 1> gained{};
  std::uint64_t left = 0;
  for (std::uint32_t p = 0; p < decoder.part_count(); ++p) {
    const Result<FourKPart> part = decoder.read_part(p);
    if (!part) return part.error();
    const FourKMesh& mesh = part->mesh;
    if (p > 0 || decoder.part_count() == 1) left += mesh.finest_count;
    for (Index o = 0; o < mesh.operation_count(); ++o)
      gained[static_cast<std::size_t>(quantized_error(mesh.error[o]))] +=
          mesh.destroyed_by(o).size() - mesh.created_count(o);
  }
  for (std::int32_t q = 0; q < kLargestError; ++q) {
    left -= std::min(left, gained[static_cast<std::size_t>(q)]);
    if (left <= triangles) return error_value(q);
  }
  return error_value(kLargestError);
}

Result<PartsMesh> mesh_at_error(const FourKDecoder& decoder, float error) {
  assert(decoder.is_whole());
  Gathered gathered;
  const Result<FourKPart> joined = decoder.read_part(0);
  if (!joined) return joined.error();
  std::vector<Triangle> shared;  // the tiles' coarsest triangles that are still there, by the input's numbers
  const bool has_tiles = decoder.part_count() > 1;
  for (Index t = 0; t < joined->mesh.triangle_count(); ++t) {
    if (!is_left(joined->mesh, t, error)) continue;
    if (!has_tiles || joined->mesh.creator[t] != kNone) {
      gathered.add(*joined, t);
      continue;
    }
    Triangle corners = joined->mesh.triangles[t];
    for (Index& corner : corners) corner = joined->numbers[corner];
    shared.push_back(begun_with_least(corners));
  }
  gathered.settle();
  std::sort(shared.begin(), shared.end());
  for (std::uint32_t p = 1; p < decoder.part_count(); ++p) {
    const Result<FourKPart> part = decoder.read_part(p);
    if (!part) return part.error();
    for (Index t = 0; t < part->mesh.triangle_count(); ++t) {
      if (!is_left(part->mesh, t, error)) continue;
      Triangle corners = part->mesh.triangles[t];
      for (Index& corner : corners) corner = part->numbers[corner];
      const bool is_coarsest = part->mesh.destroyer[t] == kNone;
      if (!is_coarsest || std::binary_search(shared.begin(), shared.end(), begun_with_least(corners)))
        gathered.add(*part, t);
    }
    gathered.settle();
  }
  return std::move(gathered).take();
}

}  // namespace limber
