// SPDX-License-Identifier: Apache-2.0
#include "limber/hierarchy/worth.h"

#include "limber/base/portable_math.h"

namespace limber {

void Worth::set_weights(double growth, double coarser_weight) {
  const Hierarchy& h = clusters_.hierarchy();
  level_weight_.assign(h.level_count(), 1.0);
  for (Index level = 2; level < h.level_count(); ++level) {
    const double ratio = static_cast<double>(h.level_size(level)) / h.level_size(level - 1);
    level_weight_[level] = coarser_weight * portable_exp(growth * portable_log(ratio));
  }
}

double Worth::release(Index node) const {
  const Quadric& q = clusters_.quadric(node);
  const Index from = clusters_.parent(node);
  if (benefit_ == Benefit::kFixed) return q(clusters_.minimum_at(from));
  return clusters_.energy(from) - minimum(clusters_.quadric(from) - q).value;
}

// By how much the error of the cluster grows with the quadric.
double Worth::burden(const Quadric& q, Index cluster) const {
  if (benefit_ == Benefit::kFixed) return q(clusters_.minimum_at(cluster));
  return minimum(clusters_.quadric(cluster) + q).value - clusters_.energy(cluster);
}

// By how much the errors of both clusters fall when the quadric leaves one for the other.
double Worth::exchange(const Quadric& q, Index from, Index to) const {
  if (benefit_ == Benefit::kFixed) return q(clusters_.minimum_at(from)) - q(clusters_.minimum_at(to));
  const Double2 left = minimum_values(clusters_.quadric(from) - q, clusters_.quadric(to) + q);
  return clusters_.energy(from) - left[0] - (left[1] - clusters_.energy(to));
}

// What the coarser levels gain.
double Worth::above(Index node, Index to) const {
  const Quadric& q = clusters_.quadric(node);
  double sum = 0, weight = 1;
  Index from = clusters_.parent(clusters_.parent(node));
  to = clusters_.parent(to);
  if (from == to) return sum;
  for (Index level = clusters_.hierarchy().level_of(from); from != to; ++level) {
    weight *= level_weight_[level];
    sum += weight * exchange(q, from, to);
    from = clusters_.parent(from), to = clusters_.parent(to);
  }
  return sum;
}

double Worth::of_swap(Index node, Index to) const {
  return exchange(clusters_.quadric(node), clusters_.parent(node), to) + above(node, to);
}

void Worth::of_swaps(Index node, std::span<const Index> to, std::span<double> worth) const {
  const Quadric& q = clusters_.quadric(node);
  const Index from = clusters_.parent(node);
  if (benefit_ == Benefit::kFixed) {
    for (std::size_t i = 0; i < to.size(); ++i) worth[i] = exchange(q, from, to[i]) + above(node, to[i]);
    return;
  }
  const Double2 first = minimum_values(clusters_.quadric(from) - q, clusters_.quadric(to[0]) + q);
  const double release = clusters_.energy(from) - first[0];
  worth[0] = release - (first[1] - clusters_.energy(to[0]));
  for (std::size_t i = 1; i < to.size(); i += 2) {
    const std::size_t j = std::min(i + 1, to.size() - 1);
    const Double2 least = minimum_values(clusters_.quadric(to[i]) + q, clusters_.quadric(to[j]) + q);
    worth[i] = release - (least[0] - clusters_.energy(to[i]));
    worth[j] = release - (least[1] - clusters_.energy(to[j]));
  }
  for (std::size_t i = 0; i < to.size(); ++i) worth[i] += above(node, to[i]);
}

double Worth::of_death(Index cluster, Index heir) const {
  const double worth = clusters_.energy(cluster) - burden(clusters_.quadric(cluster), heir);
  const Index to = clusters_.parent(heir);
  if (clusters_.parent(cluster) == to) return worth;
  return worth + level_weight_[clusters_.hierarchy().level_of(to)] * of_swap(cluster, to);
}

}  // namespace limber
