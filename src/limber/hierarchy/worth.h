// SPDX-License-Identifier: Apache-2.0
// What a change of the hierarchy is worth (Kircher & Garland 2005, equations 1 and 2).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "limber/hierarchy/clustering.h"

namespace limber {

enum class Benefit {
  kExact,  // both minima are found anew
  kFixed,  // both minima stay in their places (equation 1): never more than the exact one, in half the time
};

// By how much the error of a level falls, plus by how much those of all coarser ones do, weighted.
class Worth {
 public:
  // The clustering must outlive this object.
  Worth(const Clustering& clustering, Benefit benefit) : clusters_(clustering), benefit_(benefit) {}

  // Each level weighs coarser_weight x (its size / that of the level below)^growth of what the level below does.
  void set_weights(double growth, double coarser_weight);

  // Of the node's leaving its parent for `to`, one level above it.
  double of_swap(Index node, Index to) const;

  // The same for each of several, at least one, in less time: worth[i] of to[i].
  void of_swaps(Index node, std::span<const Index> to, std::span<double> worth) const;

  // By how much the error of the node's cluster falls without it.
  double release(Index node) const;

  // Estimates for about a fifth of the time, of release() and of what the error of another cluster grows by with a
  // quadric, to choose what is worth being judged exactly: where quadrics are distances to points, a cluster's minimum
  // moves by the share that comes or goes (Hartigan's rule for k-means). What is less than the share kLikely of what it
  // would have to be need not be.
  static constexpr double kLikely = 0.5;
  double about_release(Index node) const {
    const Quadric &q = clusters_.quadric(node), &all = clusters_.quadric(clusters_.parent(node));
    const double whole = all.trace(), rest = std::max(whole - q.trace(), 1e-3 * whole);
    return rest > 0 ? q(clusters_.minimum_at(clusters_.parent(node))) * (whole / rest) : 0;
  }
  double about_burden(const Quadric& q, Index cluster) const {
    const double whole = clusters_.quadric(cluster).trace(), with = whole + q.trace();
    return with > 0 ? q(clusters_.minimum_at(cluster)) * (whole / with) : 0;
  }

  // Of the end of a cluster whose children all go to `heir`, on the same level: <= 0 but for what coarser levels gain.
  double of_death(Index cluster, Index heir) const;

 private:
  double burden(const Quadric& quadric, Index cluster) const;
  double exchange(const Quadric& quadric, Index from, Index to) const;
  double above(Index node, Index to) const;

  const Clustering& clusters_;
  Benefit benefit_;
  std::vector<double> level_weight_;  // [level_count]: of a level against the one below
};

}  // namespace limber
