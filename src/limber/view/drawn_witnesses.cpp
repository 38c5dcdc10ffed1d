// SPDX-License-Identifier: Apache-2.0
#include "limber/view/drawn_witnesses.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "limber/view/downhill.h"

namespace limber {

DrawnWitnesses::DrawnWitnesses(const Mesh& mesh, const Hierarchy& hierarchy)
    : node_faces_(hierarchy.node_count() - hierarchy.vertex_count(), kNone),
      faces_(mesh.triangles.size(), {kNone, kNone, kNone, kNone}),
      known_at_(hierarchy.node_count(), 0) {
  failing_.reserve(std::size_t{64} + mesh.vertex_count);
  list_.triangles.reserve(mesh.triangles.size());
  list_.faces.reserve(mesh.triangles.size());
  list_.living.reserve(mesh.triangles.size());
  list_.slots.reserve(std::bit_ceil(4 * mesh.triangles.size() + 1));
}

void DrawnWitnesses::begin() {
  first_round_ = ++round_;
  largest_square_ = 0;
}

// The square of the distance to the witness, or to a nearer one that becomes it.
float DrawnWitnesses::bound(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn, const Vec3f& point,
                            Index start, float enough, Index& witness) {
  if (witness != kNone) {
    const float square = squared_distance_to_face(mesh, drawn.positions, point, witness);
    if (square <= enough) return square;
    const NearFace near = walk_downhill(mesh, stars, drawn.positions, point, mesh.triangles[witness][0], enough);
    if (near.square <= enough) {
      witness = near.face;
      return near.square;
    }
  }
  const NearFace near = walk_downhill(mesh, stars, drawn.positions, point, start, enough);
  witness = near.face;
  return near.square;
}

void DrawnWitnesses::find(const Mesh& mesh, const Stars& stars, const DrawnSurface& drawn,
                          std::span<const float> weights, float limit, std::span<const std::uint8_t> has_changed) {
  assert(weights.size() == node_faces_.size());
  const Index base = mesh.vertex_count;
  const float most = limit * limit;
  ++round_;
  failing_.clear();
  const auto judge = [&](Index node, float square) {
    if (square <= most) {
      largest_square_ = std::max(largest_square_, square);
    } else if (failing_.size() < failing_.capacity()) {
      failing_.push_back({node, square});
    }
  };
  if (has_changed.empty()) {
    list_triangles(mesh, drawn.labels, list_);
  } else {
    list_triangles_around(mesh, drawn.labels, has_changed, list_);
  }
  for (std::size_t i = 0; i < list_.triangles.size(); ++i) {
    const Triangle& image = list_.triangles[i];
    const Triangle& face = mesh.triangles[list_.faces[i]];
    bool is_new = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index node = image[k];
      if (known_at_[node] < first_round_) {
        known_at_[node] = round_;
        if (node >= base) {
          const float scale = weights[node - base] * weights[node - base];
          judge(node, scale * bound(mesh, stars, drawn, drawn.positions[node], face[k], most / scale,
                                    node_faces_[node - base]));
        }
      }
      is_new |= known_at_[node] == round_;
    }
    const Index coarsest = std::max({image[0], image[1], image[2]});
    if (!is_new || coarsest < base) continue;
    float weight = 0;
    for (const Index node : image) weight = std::max(weight, node < base ? drawn.weights[node] : weights[node - base]);
    const float scale = weight * weight, enough = most / scale;
    const Vec3f& a = drawn.positions[image[0]];
    const Vec3f& b = drawn.positions[image[1]];
    const Vec3f& c = drawn.positions[image[2]];
    std::array<Index, 4>& witnesses = faces_[list_.faces[i]];
    judge(coarsest, scale * bound(mesh, stars, drawn, (a + b + c) * (1.0f / 3), face[0], enough, witnesses[3]));
    for (std::size_t k = 0; k < 3; ++k) {
      const Index from = image[k], to = image[(k + 1) % 3];
      if (std::max(from, to) < base || from > to) continue;
      const Vec3f middle = 0.5f * (drawn.positions[from] + drawn.positions[to]);
      judge(std::max(from, to), scale * bound(mesh, stars, drawn, middle, face[k], enough, witnesses[k]));
    }
  }
}

}  // namespace limber
