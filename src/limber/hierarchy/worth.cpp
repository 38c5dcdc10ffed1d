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

// By how much the error of the cluster falls without the quadric, which is part of its own.
double Worth::without(const Quadric& q, Index cluster) const {
  if (benefit_ == Benefit::kFixed) return q(clusters_.minimum_at(cluster));
  return clusters_.energy(cluster) - minimum(clusters_.quadric(cluster) - q).value;
}

double Worth::burden(const Quadric& q, Index cluster) const {
  if (benefit_ == Benefit::kFixed) return q(clusters_.minimum_at(cluster));
  return minimum(clusters_.quadric(cluster) + q).value - clusters_.energy(cluster);
}

double Worth::release(Index node) const { return without(clusters_.quadric(node), clusters_.parent(node)); }

double Worth::of_swap(Index node, Index to, double release) const {
  const Quadric& q = clusters_.quadric(node);
  double sum = release - burden(q, to), weight = 1;
  Index from = clusters_.parent(clusters_.parent(node));
  to = clusters_.parent(to);
  if (from == to) return sum;
  for (Index level = clusters_.hierarchy().level_of(from); from != to; ++level) {
    weight *= level_weight_[level];
    sum += weight * (without(q, from) - burden(q, to));
    from = clusters_.parent(from), to = clusters_.parent(to);
  }
  return sum;
}

double Worth::of_death(Index cluster, Index heir) const {
  const double worth = clusters_.energy(cluster) - burden(clusters_.quadric(cluster), heir);
  const Index to = clusters_.parent(heir);
  if (clusters_.parent(cluster) == to) return worth;
  return worth + level_weight_[clusters_.hierarchy().level_of(to)] * of_swap(cluster, to);
}

}  // namespace limber
