// SPDX-License-Identifier: Apache-2.0
// Lindstrom & Turk 1998. Differences: docs/design.md, "Volume placement".
//
//   contract_to(target):
//     while vertex_count > target:
//       take the edge of least cost
//       if its surroundings have changed since it was priced:  placement() again, back into the queue
//       else if it would break the topology or fold over:      put off until its surroundings change
//       else:                                                  apply()
//     with nothing left to take: give every edge put off another chance, then one without the fold-over check
//
// Nothing is accumulated: costs are those of the surface as it is. They may fall when the surroundings change, and an
// edge whose cost has fallen is found only when its old cost comes to the front.
#include "limber/contract/volume_contractor.h"

#include <cassert>
#include <utility>

#include "limber/contract/fetch.h"
#include "limber/contract/orientation.h"

namespace limber {
namespace {

// Of the corners of a triangle, those that follow `corner`.
std::array<Index, 2> corners_after(const Triangle& t, Index corner) {
  const bool is_second = t[1] == corner, is_third = t[2] == corner;
  return {t[is_second ? 2 : !is_third], t[is_second ? 0 : 2 - is_third]};
}

bool has_corner(const Triangle& t, Index v) { return t[0] == v || t[1] == v || t[2] == v; }

}  // namespace

VolumeContractor::VolumeContractor(const Mesh& mesh, std::span<const Vec3f> positions, const ContractOptions& options,
                                   GoOnFunction go_on)
    : Contraction(std::move(go_on)), topology_(options.topology) {
  assert(positions.size() == mesh.vertex_count);
  Mesh oriented = mesh;
  orient_alike(oriented);
  if (!goes_on(kStepsUnasked)) return;
  adopt(oriented, positions);
  if (is_cancelled()) return;
  normalization_ = normalization(positions);
  positions_.resize(order_.size());
  for (Index i = 0; i < order_.size(); ++i) positions_[i] = normalization_.to_unit(positions[order_[i]]);
  facets_.resize(mesh.triangles.size());
  for (Index t = 0; t < facets_.size(); ++t)
    if (surface_.triangle(t)[0] != kNone) update_facet(t);
  stars_.resize(order_.size());
  is_old_star_.resize(order_.size(), true);
  met_.resize(order_.size());
  start_queue([this](Index edge) { return cost(edge); });
}

void VolumeContractor::update_facet(Index triangle) {
  const auto& [a, b, c] = surface_.triangle(triangle);
  facets_[triangle] = Facet::of(positions_[a], positions_[b], positions_[c]);
}

const SymmetricMatrix& VolumeContractor::star(Index v) {
  if (is_old_star_[v]) update_star(v);
  return stars_[v];
}

void VolumeContractor::update_star(Index v) {
  SymmetricMatrix sum;
  ++round_;
  surface_.for_each_triangle(v, [&](Index t) {
    add_facet(sum, facets_[t]);
    for (const Index w : corners_after(surface_.triangle(t), v)) {
      const bool is_first = met_[w].round != round_;
      met_[w].round = round_;
      met_[w].triangles[!is_first] = t;
    }
  });
  surface_.for_each_edge(v, [&](Index e, Index w) {
    const auto& [s, t] = met_[w].triangles;
    const double weight = surface_.triangle_count(e) == 2 ? rim_weight(facets_[s], facets_[t]) : kBorderWeight;
    if (weight > 0) add_rim(sum, positions_[w] - positions_[v], weight);
  });
  add_center(sum);
  stars_[v] = sum;
  is_old_star_[v] = false;
}

VolumePlacement VolumeContractor::placement(Index edge) {
  auto [u, v] = surface_.ends(edge);
  const SymmetricMatrix &first = star(u), &second = star(v);
  const Vec3d along = positions_[v] - positions_[u];
  if (surface_.triangle_bound(v) < surface_.triangle_bound(u)) std::swap(u, v);
  SymmetricMatrix shared;
  std::array<Index, 2> met{};
  surface_.for_each_triangle(u, [&, v = v](Index t) {
    if (!has_corner(surface_.triangle(t), v)) return;
    add_facet(shared, facets_[t]);
    met = {met[1], t};
  });
  const bool is_inside = surface_.triangle_count(edge) == 2;
  const double weight = is_inside ? rim_weight(facets_[met[0]], facets_[met[1]]) : kBorderWeight;
  if (weight > 0) add_rim(shared, along, weight);
  return place(first, second, shared, along);
}

float VolumeContractor::cost(Index edge) { return static_cast<float>(placement(edge).cost); }

// Whether moving both ends to `point` takes its area from a triangle that survives, or turns it by 90 degrees or more.
bool VolumeContractor::folds_over(Index edge, const Vec3d& point) {
  const auto [u, v] = surface_.ends(edge);
  bool found = false;
  for (const Index end : {u, v}) {
    const Index other = u ^ v ^ end;
    surface_.for_each_triangle(end, [&](Index t) {
      const auto [b, c] = corners_after(surface_.triangle(t), end);
      if (found || b == other || c == other) return;
      const Facet& facet = facets_[t];
      found = facet.area > 0 && dot(cross(positions_[b] - point, positions_[c] - point), facet.normal) <= 0;
    });
  }
  return found;
}

void VolumeContractor::apply(Index edge, const Vec3d& point) {
  const auto [u, v] = surface_.ends(edge);
  positions_[u] = point;
  merged_into_[v] = u;
  for (const Index gone : surface_.contract(edge)) state_[gone] = EdgeState::kGone;
  surface_.for_each_triangle(u, [this](Index t) { update_facet(t); });
  is_old_star_[u] = true;
  ring_.clear();
  surface_.for_each_edge(u, [this](Index, Index w) {
    is_old_star_[w] = true;
    ring_.push_back(w);
  });
  // Every edge of the ring has another cost; one that was put off may be legal now. They are priced last, because that
  // walks the same runs of the surface.
  again_.clear();
  const auto touch = [this](Index e, Index) {
    if (state_[e] == EdgeState::kPutOff) again_.push_back(e);
    state_[e] = EdgeState::kStale;
  };
  surface_.for_each_edge(u, touch);
  for (const Index w : ring_) surface_.for_each_edge(w, touch);
  for (const Index e : again_) enqueue(e, cost(e));
}

void VolumeContractor::fetch_step(Index edge, int step) const {
  switch (step) {
    case 0:
      return surface_.fetch_edge(edge);
    case 1:
      return surface_.fetch_ends(edge, [this](Index v) {
        fetch(&stars_[v].xx);
        fetch(&stars_[v].zz);
        fetch(&positions_[v]);
        fetch(&is_old_star_[v]);
      });
    case 2:
      return surface_.fetch_runs(edge);
    case 3:
      surface_.fetch_records(edge);
      return surface_.fetch_triangles(edge, [this](Index t) { fetch(&facets_[t]); });
    default:
      return surface_.fetch_neighbours(edge, [this](Index v) {
        fetch(&positions_[v]);
        fetch(&met_[v]);
      });
  }
}

// What the next contractions will touch is on its way while this one is made.
void VolumeContractor::fetch_ahead() const {
  for (int step = 0; step < 5; ++step) {
    const Index e = queue_.upcoming(static_cast<std::size_t>(9 - 2 * step));
    if (e != kNone && state_[e] == EdgeState::kPriced) fetch_step(e, step);
  }
}

Index VolumeContractor::contract_to(Index target) {
  // The queue names an edge 16 edges before its turn: its steps are made then, and when it names those that follow.
  std::array<Index, 16> named{};
  std::size_t name_count = 0;
  const auto fetch_early = [&](Index edge) {
    named[name_count++ % 16] = edge;
    for (int step = 0; step < 5; ++step) {
      const Index e = named[(name_count - 1 - 3 * static_cast<std::size_t>(step)) % 16];
      if (state_[e] == EdgeState::kStale) fetch_step(e, step);
    }
  };
  const auto attempt = [this](Index edge) {
    const auto [u, v] = surface_.ends(edge);
    const Vec3d point = (positions_[u] + positions_[v]) * 0.5 + placement(edge).point;
    if ((topology_ == Topology::kPreserve && !surface_.keeps_topology(edge)) ||
        (check_fold_over_ && folds_over(edge, point)))
      return false;
    apply(edge, point);
    return true;
  };
  return contract_cheapest(
      target, [this](Index edge) { return cost(edge); }, fetch_early, [](Index) {}, [this] { fetch_ahead(); }, attempt);
}

Vec3f VolumeContractor::position(Index representative, [[maybe_unused]] std::size_t frame) const {
  const Index place = places_[representative];
  assert(merged_into_[place] == kNone && frame == 0);
  return normalization_.from_unit(positions_[place]);
}

}  // namespace limber
