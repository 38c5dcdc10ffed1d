// SPDX-License-Identifier: Apache-2.0
#include "eval/methods/feature_weight.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace limber::eval {
namespace {

struct Border {
  Index edge_count = 0;               // boundary edges at the ends, without the edge itself
  std::optional<double> most_folded;  // the largest cosine of their angles with the edge
};

double cosine(const Vec3d& a, const Vec3d& b) {
  const double lengths = squared_length(a) * squared_length(b);
  return lengths > 0 ? std::clamp(dot(a, b) / std::sqrt(lengths), -1.0, 1.0) : -1;
}

Border border_at(Surface& surface, Index edge, const FramePositions& positions) {
  Border border;
  const auto ends = surface.ends(edge);
  for (const Index end : ends) {
    const Index other = ends[0] ^ ends[1] ^ end;
    surface.for_each_edge(end, [&](Index e, Index w) {
      if (e == edge || surface.triangle_count(e) != 1) return;
      ++border.edge_count;
      const double angle = cosine(positions[w] - positions[end], positions[other] - positions[end]);
      border.most_folded = std::max(border.most_folded.value_or(-1), angle);
    });
  }
  return border;
}

}  // namespace

double meeting_cosine(Surface& surface, Index edge, const FramePositions& positions) {
  const auto [u, v] = surface.ends(edge);
  const Vec3d along = positions[v] - positions[u];
  const double squared = squared_length(along);
  if (surface.triangle_count(edge) != 2 || !(squared > 0)) return -1;
  Vec3d away[2];
  std::size_t count = 0;
  surface.for_each_triangle(u, [&, u = u, v = v](Index t) {
    const Triangle& corners = surface.triangle(t);
    if (corners[0] != v && corners[1] != v && corners[2] != v) return;
    const Vec3d to = positions[corners[0] ^ corners[1] ^ corners[2] ^ u ^ v] - positions[u];
    if (count < 2) away[count++] = to - along * (dot(to, along) / squared);
  });
  return count == 2 ? cosine(away[0], away[1]) : -1;
}

double feature_weight(Surface& surface, Index edge, const FramePositions& positions, double sharp_cosine,
                      bool literal) {
  const Index triangle_count = surface.triangle_count(edge);
  const Border border = border_at(surface, edge, positions);
  if (triangle_count == 1) {
    if (!border.most_folded) return 0;
    return literal ? *border.most_folded : (1 + *border.most_folded) / 2;
  }
  double weight = border.edge_count / 4.0;
  if (triangle_count >= 3) weight += triangle_count - (literal ? 3.0 : 2.0);
  if (triangle_count == 2) {
    const double alpha_cosine = meeting_cosine(surface, edge, positions);
    if (alpha_cosine > sharp_cosine)
      weight += std::sqrt(literal ? 1 - alpha_cosine * alpha_cosine : (1 + alpha_cosine) / 2);
  }
  return weight;
}

}  // namespace limber::eval
