// SPDX-License-Identifier: Apache-2.0
#include "eval/report/worst_places.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace limber::eval {
namespace {

constexpr double kNeighborhood = 0.05;  // its side, as a share of the diagonal

}  // namespace

WorstPlaces::WorstPlaces(std::size_t method_count, std::size_t sample_count, std::uint64_t seed)
    : wanted_samples_(sample_count),
      seed_(seed),
      distributions_(method_count),
      places_(method_count),
      squared_(method_count) {
  assert(method_count > 0 && sample_count > 0);
}

// The samples, those of a neighbourhood next to each other. A place is at an end of a run where a new cell begins.
std::vector<std::size_t> WorstPlaces::by_neighborhood(const Vec3d& low, double side) const {
  using Cell = std::array<long, 3>;
  std::vector<Cell> cells(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vec3d p = (points_[i] - low) * (1 / side);
    cells[i] = {static_cast<long>(std::floor(p.x)), static_cast<long>(std::floor(p.y)),
                static_cast<long>(std::floor(p.z))};
  }
  std::vector<std::size_t> order(points_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return cells[a] < cells[b]; });
  return order;
}

std::vector<std::size_t> WorstPlaces::add(const Surface& original, std::span<const Surface> approximations) {
  assert(approximations.size() == places_.size());
  if (samples_.empty()) {
    const AreaSamples area(original, wanted_samples_, seed_);
    samples_.resize(area.size());
    area.fill(0, samples_);
    points_.resize(samples_.size());
    closest_.resize(samples_.size());
  }
  for (std::size_t i = 0; i < samples_.size(); ++i)
    points_[i] = point_at(original, samples_[i].triangle, samples_[i].barycentric);
  const Box box = bounding_box(original);
  const double diagonal = box.diagonal();
  for (std::size_t m = 0; m < approximations.size(); ++m) {
    tree_.rebuild(approximations[m]);
    tree_.closest(points_, closest_);
    squared_[m].resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      squared_[m][i] = 1e4 * closest_[i].squared_distance / (diagonal * diagonal);
      distributions_[m].add(std::sqrt(squared_[m][i]));
    }
  }

  const double side = kNeighborhood * diagonal;
  const std::vector<std::size_t> order = by_neighborhood(box.low, side);
  const auto cell_of = [&](std::size_t i) {
    const Vec3d p = (points_[i] - box.low) * (1 / side);
    return std::array{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  };
  std::vector<std::size_t> worse;
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && cell_of(order[end]) == cell_of(order[begin])) ++end;
    for (std::size_t m = 0; m < places_.size(); ++m) {
      double loss = 0, most = -1;
      std::size_t worst = order[begin];
      for (std::size_t k = begin; k < end; ++k) {
        const std::size_t i = order[k];
        const double here = squared_[m][i] - (m == 0 ? 0.0 : squared_[0][i]);
        loss += here;
        if (here > most) most = here, worst = i;
      }
      if (places_[m] && loss <= places_[m]->loss) continue;
      WorstPlace place{.frame = frame_, .point = points_[worst], .normal = {}, .loss = loss, .rms = {}};
      const Vec3d area = area_vector(original, samples_[worst].triangle);
      if (length(area) > 0) place.normal = area * (1 / length(area));
      for (const std::vector<double>& squared : squared_) {
        double sum = 0;
        for (std::size_t k = begin; k < end; ++k) sum += squared[order[k]];
        place.rms.push_back(std::sqrt(sum / static_cast<double>(end - begin)));
      }
      places_[m] = place;
      if (worse.empty() || worse.back() != m) worse.push_back(m);
    }
    begin = end;
  }
  ++frame_;
  std::sort(worse.begin(), worse.end());
  worse.erase(std::unique(worse.begin(), worse.end()), worse.end());
  return worse;
}

}  // namespace limber::eval
