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

Triangle in_input(const FourKPart& part, Index t) {
  Triangle corners = part.mesh.triangles[t];
  for (Index& corner : corners) corner = part.numbers[corner];
  return begun_with_least(corners);
}

// Whether a triangle is there when these operations are applied.
bool is_left(const FourKMesh& mesh, Index t, std::span<const std::uint8_t> applied) {
  const Index creator = mesh.creator[t], destroyer = mesh.destroyer[t];
  return (creator == kNone || applied[creator]) && (destroyer == kNone || !applied[destroyer]);
}

// A coarsest triangle of a tile, by the input's numbers, and what has created it.
struct Joint {
  Triangle corners;
  Vec3f center;
  float radius = 0, error = 0;
};

// Of all tiles, sorted.
Result<std::vector<Joint>> read_joints(const FourKDecoder& decoder) {
  std::vector<Joint> joints;
  for (std::uint32_t p = 1; p < decoder.part_count(); ++p) {
    const Result<FourKPart> part = decoder.read_part(p);
    if (!part) return part.error();
    const FourKMesh& mesh = part->mesh;
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.destroyer[t] != kNone) continue;
      const Index c = mesh.creator[t];
      joints.push_back({in_input(*part, t), part->positions[c == kNone ? mesh.triangles[t][0] : mesh.vertex[c]],
                        c == kNone ? 0 : mesh.radius[c], c == kNone ? 0 : mesh.error[c]});
    }
  }
  std::sort(joints.begin(), joints.end(), [](const Joint& a, const Joint& b) { return a.corners < b.corners; });
  return joints;
}

// nullptr where no tile has the triangle.
const Joint* find(std::span<const Joint> joints, const Triangle& corners) {
  const auto found = std::lower_bound(joints.begin(), joints.end(), corners,
                                      [](const Joint& a, const Triangle& b) { return a.corners < b; });
  return found != joints.end() && found->corners == corners ? &*found : nullptr;
}

// Gives the operations of the first part spheres that hold those of the tiles' operations that they depend on.
void hold_spheres(FourKPart& joined, std::span<const Joint> joints) {
  // More than what rounding does to distances between spheres.
  constexpr double kMargin = 1 + 1e-5;
  FourKMesh& mesh = joined.mesh;
  for (Index o = 0; o < mesh.operation_count(); ++o) {
    const auto center = static_cast<Vec3d>(joined.positions[mesh.vertex[o]]);
    double radius = 0;
    const auto hold = [&](const Vec3f& other, float reach) {
      radius = std::max(radius, length(static_cast<Vec3d>(other) - center) + static_cast<double>(reach));
    };
    for (const Index t : mesh.destroyed_by(o)) {
      const Index c = mesh.creator[t];
      if (c != kNone)
        hold(joined.positions[mesh.vertex[c]], mesh.radius[c]);
      else if (const Joint* const joint = find(joints, in_input(joined, t)))
        hold(joint->center, joint->radius);
    }
    mesh.radius[o] = std::max(mesh.radius[o], static_cast<float>(radius * kMargin));
  }
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

// What is left by the operations that applied_of(part) says. `joined`: the first part.
template <class AppliedOf>
Result<PartsMesh> gather(const FourKDecoder& decoder, const FourKPart& joined, const AppliedOf& applied_of) {
  Gathered gathered;
  std::vector<Triangle> shared;  // the tiles' coarsest triangles that are still there, by the input's numbers
  const bool has_tiles = decoder.part_count() > 1;
  const std::vector<std::uint8_t> applied = applied_of(joined);
  for (Index t = 0; t < joined.mesh.triangle_count(); ++t) {
    if (!is_left(joined.mesh, t, applied)) continue;
    if (!has_tiles || joined.mesh.creator[t] != kNone)
      gathered.add(joined, t);
    else
      shared.push_back(in_input(joined, t));
  }
  gathered.settle();
  std::sort(shared.begin(), shared.end());
  for (std::uint32_t p = 1; p < decoder.part_count(); ++p) {
    const Result<FourKPart> part = decoder.read_part(p);
    if (!part) return part.error();
    const std::vector<std::uint8_t> in_tile = applied_of(*part);
    for (Index t = 0; t < part->mesh.triangle_count(); ++t) {
      if (!is_left(part->mesh, t, in_tile)) continue;
      const bool is_coarsest = part->mesh.destroyer[t] == kNone;
      if (!is_coarsest || std::binary_search(shared.begin(), shared.end(), in_input(*part, t))) gathered.add(*part, t);
    }
    gathered.settle();
  }
  return std::move(gathered).take();
}

}  // namespace

Result<float> error_for_size(const FourKDecoder& decoder, std::uint64_t size, FrontBudget unit) {
  assert(decoder.is_whole());
  const bool vertices = unit == FrontBudget::kVertices;
  std::array<std::uint64_t, kLargestError + 1> gained{};
  std::uint64_t left = vertices ? decoder.header().vertex_count : 0;
  for (std::uint32_t p = 0; p < decoder.part_count(); ++p) {
    const Result<FourKPart> part = decoder.read_part(p);
    if (!part) return part.error();
    const FourKMesh& mesh = part->mesh;
    if (!vertices && (p > 0 || decoder.part_count() == 1)) left += mesh.finest_count;
    for (Index o = 0; o < mesh.operation_count(); ++o)
      gained[static_cast<std::size_t>(quantized_error(mesh.error[o]))] +=
          vertices ? mesh.is_removal(o) : mesh.destroyed_by(o).size() - mesh.created_count(o);
  }
  for (std::int32_t q = 0; q < kLargestError; ++q) {
    left -= std::min(left, gained[static_cast<std::size_t>(q)]);
    if (left <= size) return error_value(q);
  }
  return error_value(kLargestError);
}

Result<PartsMesh> mesh_at_error(const FourKDecoder& decoder, float error) {
  assert(decoder.is_whole());
  const Result<FourKPart> joined = decoder.read_part(0);
  if (!joined) return joined.error();
  return gather(decoder, *joined, [error](const FourKPart& part) {
    std::vector<std::uint8_t> applied(part.mesh.operation_count());
    for (Index o = 0; o < part.mesh.operation_count(); ++o) applied[o] = part.mesh.error[o] <= error;
    return applied;
  });
}

Result<PartsMesh> mesh_for_request(const FourKDecoder& decoder, const FrontRequest& request) {
  assert(decoder.is_whole() && !request.level && !request.vertices && !request.triangles && !request.bend);
  Result<FourKPart> joined = decoder.read_part(0);
  if (!joined) return joined.error();
  if ((request.view || request.focus) && decoder.part_count() > 1) {
    const Result<std::vector<Joint>> joints = read_joints(decoder);
    if (!joints) return joints.error();
    hold_spheres(*joined, *joints);
  }
  return gather(decoder, *joined,
                [&](const FourKPart& part) { return applied_operations(part.mesh, part.positions, request); });
}

Result<std::optional<std::string>> validate_joints(const FourKDecoder& decoder) {
  assert(decoder.is_whole());
  if (decoder.part_count() == 1) return std::optional<std::string>();
  const Result<FourKPart> joined = decoder.read_part(0);
  if (!joined) return joined.error();
  const Result<std::vector<Joint>> joints = read_joints(decoder);
  if (!joints) return joints.error();
  const FourKMesh& mesh = joined->mesh;
  std::vector<Triangle> finest;
  for (Index t = 0; t < mesh.finest_count; ++t) {
    finest.push_back(in_input(*joined, t));
    const Joint* const joint = find(*joints, finest.back());
    if (joint != nullptr && mesh.destroyer[t] != kNone && mesh.error[mesh.destroyer[t]] < joint->error)
      return std::optional<std::string>(
          "an operation of the first part has a smaller error than one that it depends on");
  }
  std::sort(finest.begin(), finest.end());
  if (!std::ranges::equal(finest, *joints, {}, {}, &Joint::corners) ||
      std::ranges::adjacent_find(finest) != finest.end())
    return std::optional<std::string>("the finest triangles of the first part are not the coarsest of the others");
  return std::optional<std::string>();
}

}  // namespace limber
