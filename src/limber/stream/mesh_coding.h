// SPDX-License-Identifier: Apache-2.0
// Coding the triangles of a mesh, for both directions: in their order, with the rotation of their corners and the
// numbers of the vertices as they are. Part of the player.
//
// A triangle either continues over an edge met lately (which one, where in the triangle it lies, and the third
// corner), or is given by three corners. A corner that follows another is the end of an open edge there (one whose
// other side has no triangle yet); any corner is one above the highest met yet, one met lately, or a difference
// in numbers to another corner.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/stream/range_coder.h"

namespace limber {

template <class Coder>
class MeshCoding {
 public:
  MeshCoding(Coder& coder, Index vertex_count, std::size_t triangle_count)
      : coder_(coder), vertex_count_(vertex_count), first_open_(vertex_count, kNone) {
    open_.reserve(3 * triangle_count);
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
      if (!code_next(third_, edge[1], third)) return false;
      triangle[place.rotation] = edge[0];
      triangle[(place.rotation + 1) % 3] = edge[1];
      triangle[(place.rotation + 2) % 3] = third;
    } else {
      if (!code_corner(first_, triangle_before_[0], triangle[0])) return false;
      if (!code_next(second_, triangle[0], triangle[1])) return false;
      if (!code_next(second_, triangle[1], triangle[2])) return false;
    }
    for (unsigned k = 0; k < 3; ++k) {
      // The neighbour across an edge has it the other way round.
      const Edge edge{triangle[(k + 1) % 3], triangle[k]};
      if (!found || k != place.rotation) edges_[edge_end_++ % kEdgeCount] = edge;
      if (!close(edge[1], edge[0])) open(edge[0], edge[1]);
    }
    triangle_before_ = triangle;
    return true;
  }

 private:
  static constexpr std::size_t kEdgeCount = 8;
  static constexpr std::size_t kCornerCount = 16;
  static constexpr std::size_t kMostOpen = 8;  // looked at per vertex: fans of any size cost linear time
  using Edge = std::array<Index, 2>;

  struct Place {
    std::size_t edge = kEdgeCount;
    std::uint32_t rotation = 0;
  };

  struct OpenEdge {
    Index to;
    Index next;  // of the same vertex, opened before
  };

  struct CornerModels {
    std::array<BitModel, kMostOpen> is_open;
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

  void open(Index from, Index to) {
    open_.push_back({to, first_open_[from]});
    first_open_[from] = static_cast<Index>(open_.size()) - 1;
  }

  // False where it is not open.
  bool close(Index from, Index to) {
    Index* at = &first_open_[from];
    for (std::size_t i = 0; i < kMostOpen && *at != kNone; ++i, at = &open_[*at].next) {
      if (open_[*at].to != to) continue;
      *at = open_[*at].next;
      return true;
    }
    return false;
  }

  // The corner that follows `before` in the triangle.
  bool code_next(CornerModels& models, Index before, Index& corner) {
    Index at = first_open_[before];
    for (std::size_t i = 0; i < kMostOpen && at != kNone; ++i, at = open_[at].next) {
      if (!coder_.bit(models.is_open[i], open_[at].to == corner)) continue;
      corner = open_[at].to;
      return true;
    }
    return code_corner(models, before, corner);
  }

  bool code_corner(CornerModels& models, Index reference, Index& corner) {
    if (coder_.bit(models.is_new, corner == next_unmet_)) {
      corner = next_unmet_;
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
    if (corner >= next_unmet_) next_unmet_ = corner + 1;
    corners_[corner_end_++ % kCornerCount] = corner;
    return true;
  }

  Coder& coder_;
  Index vertex_count_;
  std::array<Edge, kEdgeCount> edges_{};  // a ring; the last is at edge_end_ - 1
  std::size_t edge_end_ = kEdgeCount;
  std::array<Index, kCornerCount> corners_{};
  std::size_t corner_end_ = kCornerCount;
  Index next_unmet_ = 0;  // all corners so far are lower
  Triangle triangle_before_{};
  std::vector<Index> first_open_;  // [vertex_count]
  std::vector<OpenEdge> open_;     // at most three per triangle
  unsigned continued_ = 0;         // for the last three triangles
  std::array<BitModel, 8> continues_;
  SymbolModel<3> edge_;
  SymbolModel<2> rotation_;
  CornerModels first_, second_, third_;
};

}  // namespace limber
