// SPDX-License-Identifier: Apache-2.0
// Coding the triangles of a mesh, for both directions: in their order, with the rotation of their corners and the
// numbers of the vertices as they are. Part of the player.
//
// A triangle either continues over an edge met lately (which one, where in the triangle it lies, and the third
// corner), or is given by three corners. A corner is the lowest vertex not met yet, one met lately, or a
// difference in numbers to another corner.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "limber/base/mesh.h"
#include "limber/stream/range_coder.h"

namespace limber {

template <class Coder>
class MeshCoding {
 public:
  MeshCoding(Coder& coder, Index vertex_count) : coder_(coder), vertex_count_(vertex_count) {
    edges_.fill({0, 0});
    corners_.fill(0);
  }

  // Codes the next triangle; false where the bytes are wrong.
  bool code(Triangle& triangle) {
    Place place;
    if constexpr (Coder::kEncodes) place = find(triangle);
    const unsigned kind = place.edge < kEdgeCount;
    unsigned found = coder_.bit(continues_[continued_], kind);
    continued_ = (continued_ << 1 | found) & 7;
    if (found) {
      place.edge = edge_.code(coder_, static_cast<std::uint32_t>(place.edge));
      if (place.edge >= kEdgeCount) return false;
      place.rotation = rotation_.code(coder_, place.rotation);
      if (place.rotation > 2) return false;
      const Edge edge = edges_[(edge_end_ - 1 - place.edge) % kEdgeCount];
      Index third = triangle[(place.rotation + 2) % 3];
      if (!code_corner(third_, edge[1], third)) return false;
      triangle[place.rotation] = edge[0];
      triangle[(place.rotation + 1) % 3] = edge[1];
      triangle[(place.rotation + 2) % 3] = third;
    } else {
      if (!code_corner(first_, triangle_before_[0], triangle[0])) return false;
      if (!code_corner(second_, triangle[0], triangle[1])) return false;
      if (!code_corner(second_, triangle[1], triangle[2])) return false;
    }
    for (unsigned k = 0; k < 3; ++k) {
      // The neighbour across an edge has it the other way round.
      const Edge edge{triangle[(k + 1) % 3], triangle[k]};
      if (!found || k != place.rotation) edges_[edge_end_++ % kEdgeCount] = edge;
    }
    triangle_before_ = triangle;
    return true;
  }

 private:
  static constexpr std::size_t kEdgeCount = 32;
  static constexpr std::size_t kCornerCount = 16;
  using Edge = std::array<Index, 2>;

  struct Place {
    std::size_t edge = kEdgeCount;
    std::uint32_t rotation = 0;
  };

  struct CornerModels {
    BitModel is_new;
    BitModel is_recent;
    SymbolModel<4> recent;
    DifferenceModel difference;
  };

  // The edge met last that the triangle has.
  Place find(const Triangle& triangle) const {
    for (std::size_t back = 0; back < kEdgeCount && back < edge_end_; ++back) {
      const Edge& edge = edges_[(edge_end_ - 1 - back) % kEdgeCount];
      for (unsigned k = 0; k < 3; ++k)
        if (triangle[k] == edge[0] && triangle[(k + 1) % 3] == edge[1]) return {back, k};
    }
    return {};
  }

  bool code_corner(CornerModels& models, Index reference, Index& corner) {
    if (coder_.bit(models.is_new, corner == lowest_unmet_)) {
      corner = lowest_unmet_;
    } else {
      std::size_t back = kCornerCount;
      if constexpr (Coder::kEncodes) {
        back = 0;
        while (back < kCornerCount && corners_[(corner_end_ - 1 - back) % kCornerCount] != corner) ++back;
      }
      if (coder_.bit(models.is_recent, back < kCornerCount)) {
        back = models.recent.code(coder_, static_cast<std::uint32_t>(back));
        corner = corners_[(corner_end_ - 1 - back) % kCornerCount];
        return corner < vertex_count_;
      }
      corner =
          reference + static_cast<Index>(models.difference.code(coder_, static_cast<std::int32_t>(corner - reference)));
    }
    if (corner >= vertex_count_) return false;
    if (corner >= lowest_unmet_) lowest_unmet_ = corner + 1;
    corners_[corner_end_++ % kCornerCount] = corner;
    return true;
  }

  Coder& coder_;
  Index vertex_count_;
  std::array<Edge, kEdgeCount> edges_{};  // a ring; the last is at edge_end_ - 1
  std::size_t edge_end_ = kEdgeCount;
  std::array<Index, kCornerCount> corners_{};
  std::size_t corner_end_ = kCornerCount;
  Index lowest_unmet_ = 0;  // all corners so far are lower
  Triangle triangle_before_{};
  unsigned continued_ = 0;  // for the last three triangles
  std::array<BitModel, 8> continues_;
  SymbolModel<5> edge_;
  SymbolModel<2> rotation_;
  CornerModels first_, second_, third_;
};

}  // namespace limber
