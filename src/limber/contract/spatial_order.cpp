// SPDX-License-Identifier: Apache-2.0
#include "limber/contract/spatial_order.h"

#include <algorithm>
#include <cstdint>

#include "limber/contract/bounds.h"

namespace limber {
namespace {

// Two zero bits after each of the lower ten.
std::uint32_t spread(std::uint32_t bits) {
  bits = (bits | bits << 16) & 0x030000ffu;
  bits = (bits | bits << 8) & 0x0300f00fu;
  bits = (bits | bits << 4) & 0x030c30c3u;
  return (bits | bits << 2) & 0x09249249u;
}

std::vector<Index> order_along_curve(std::span<const Vec3f> positions) {
  const Box box = bounds(positions);
  const Vec3d extent = box.empty() ? Vec3d{} : box.high - box.low;
  const double longest = std::max({extent.x, extent.y, extent.z});
  const double scale = longest > 0 ? 1023 / longest : 0;
  std::vector<std::uint64_t> keys(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3d cell = (static_cast<Vec3d>(positions[i]) - box.low) * scale;
    const std::uint64_t code = spread(static_cast<std::uint32_t>(cell.x)) |
                               spread(static_cast<std::uint32_t>(cell.y)) << 1 |
                               spread(static_cast<std::uint32_t>(cell.z)) << 2;
    keys[i] = code << 32 | i;
  }
  // Least significant digit first; the indices are in order already.
  std::vector<std::uint64_t> sorted(keys.size());
  for (int shift = 32; shift < 62; shift += 10) {
    std::size_t begin[1025] = {};
    for (const std::uint64_t key : keys) ++begin[(key >> shift & 1023) + 1];
    for (int i = 0; i < 1024; ++i) begin[i + 1] += begin[i];
    for (const std::uint64_t key : keys) sorted[begin[key >> shift & 1023]++] = key;
    keys.swap(sorted);
  }
  std::vector<Index> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = static_cast<Index>(keys[i]);
  return order;
}

}  // namespace

SpatialMesh in_spatial_order(const Mesh& mesh, std::span<const Vec3f> positions) {
  SpatialMesh out{order_along_curve(positions),
                  std::vector<Index>(mesh.vertex_count),
                  {mesh.vertex_count, std::vector<Triangle>(mesh.triangles.size())}};
  for (Index i = 0; i < mesh.vertex_count; ++i) out.places[out.order[i]] = i;
  std::vector<std::size_t> begin(mesh.vertex_count + std::size_t{1}, 0);
  for (const Triangle& t : mesh.triangles) ++begin[out.places[t[0]] + 1];
  for (Index i = 0; i < mesh.vertex_count; ++i) begin[i + 1] += begin[i];
  for (const Triangle& t : mesh.triangles)
    out.mesh.triangles[begin[out.places[t[0]]]++] = {out.places[t[0]], out.places[t[1]], out.places[t[2]]};
  return out;
}

}  // namespace limber
