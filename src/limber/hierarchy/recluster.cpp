// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, sections 4.1 to 4.3 and 5. Differences: docs/design.md, "Reclustering".
//
//   step(positions):
//     quadrics of the finest vertices, summed up the levels; minima and errors of all nodes      section 3
//     for each level, coarse to fine: improve_level()                                             section 4.3
//     sums, minima and errors once more from scratch, so that what is stored does not depend on the order of swaps
//     nodes moved from their minima to where the levels fit the surface                           level_fit.h
//
//   improve_level(level):
//     repeat until no swap is made:
//       for each node whose surroundings have changed: best_swap(), valid and better than the threshold
//       in order of benefit, those that are still valid and better: apply()
//
// Equation 1 never promises more than a swap delivers: it keeps both minima where they are, and moving them to the new
// ones can only lower the error further. Every swap lowers the weighted error by more than the threshold, so this ends.
//
// The graph of a level depends on the levels below it alone, which change after it: it is built once per frame.
#include "limber/hierarchy/recluster.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "limber/base/portable_math.h"

namespace limber {
namespace {

constexpr double kPaperGrowth = 1.9127;
constexpr double kLeastGrowth = 1, kMostGrowth = 3;  // beyond, the fit has met something else
constexpr double kRounding = 1e-18;                  // of errors of a surface of unit size

}  // namespace

Reclusterer::Reclusterer(const Mesh& mesh, Hierarchy base, const ReclusterOptions& options)
    : options_(options),
      hierarchy_(std::move(base)),
      children_(hierarchy_),
      is_valid_(hierarchy_, children_, options.topology),
      vertex_quadrics_(mesh, options.quadrics),
      graphs_(hierarchy_.level_count() - 1),
      level_weight_(hierarchy_.level_count(), 1.0),
      quadrics_(hierarchy_.node_count()),
      minima_(hierarchy_.node_count()),
      energies_(hierarchy_.node_count(), 0.0),
      positions_(hierarchy_.node_count()),
      errors_(hierarchy_.node_count(), 0.0f),
      fit_(mesh, hierarchy_),
      mark_(hierarchy_.node_count(), 0) {
  assert(hierarchy_.vertex_count() == mesh.vertex_count);
  if (!graphs_.empty()) graph_builder_.build_finest(mesh, options.topology == Topology::kFree, graphs_[0]);
}

double Reclusterer::total_error(Index level) const {
  double sum = 0;
  for (Index node = hierarchy_.level_begin[level]; node < hierarchy_.level_begin[level + 1]; ++node)
    sum += energies_[node];
  return sum;
}

void Reclusterer::measure_leeways(const LeewayOptions& options, std::span<Leeway> leeways) const {
  const Index vertex_count = hierarchy_.vertex_count();
  assert(leeways.size() == hierarchy_.node_count() - vertex_count);
  for (std::size_t i = 0; i < leeways.size(); ++i)
    leeways[i] = leeway(quadrics_[vertex_count + i], energies_[vertex_count + i], scale_, options);
}

void Reclusterer::place(Index node) {
  const QuadricMinimum at = minimum(quadrics_[node]);
  minima_[node] = at.point;
  energies_[node] = at.value;
}

// Sums the quadrics of the finest vertices up the levels, in the order of the nodes, and places every node.
void Reclusterer::place_all() {
  const Index vertex_count = hierarchy_.vertex_count(), node_count = hierarchy_.node_count();
  std::fill(quadrics_.begin() + vertex_count, quadrics_.end(), Quadric{});
  for (Index node = 0; node < node_count; ++node)
    if (hierarchy_.parent[node] != kNone) quadrics_[hierarchy_.parent[node]] += quadrics_[node];
  for (Index node = vertex_count; node < node_count; ++node) place(node);
}

// The slope of log(total error) over log(size), by least squares over the levels above the finest. Levels that the
// topology kept from shrinking say nothing about it.
double Reclusterer::fitted_growth() const {
  double count = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (Index level = 1; level < hierarchy_.level_count(); ++level) {
    const double error = total_error(level);
    if (!(error > 0) ||
        5 * std::uint64_t{hierarchy_.level_size(level)} > 4 * std::uint64_t{hierarchy_.level_size(level - 1)})
      continue;
    const double x = portable_log(hierarchy_.level_size(level)), y = portable_log(error);
    count += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread = count * sxx - sx * sx;
  if (count < 2 || !(spread > 0)) return kPaperGrowth;
  const double growth = -(count * sxy - sx * sy) / spread;
  return growth >= kLeastGrowth && growth <= kMostGrowth ? growth : kPaperGrowth;
}

// Equation 1 on the node's level and, weighted by equation 2, on all coarser ones up to the first common cluster.
double Reclusterer::benefit(Index node, Index to) const {
  const Quadric& q = quadrics_[node];
  Index from = hierarchy_.parent[node];
  Index level = hierarchy_.level_of(from);
  double sum = 0, weight = 1;
  while (from != to) {
    sum += weight * (q(minima_[from]) - q(minima_[to]));
    from = hierarchy_.parent[from], to = hierarchy_.parent[to];
    if (from == kNone) break;
    weight *= level_weight_[++level];
  }
  return sum;
}

// The valid swap of the node with the largest benefit above the least one; none: node is kNone.
Reclusterer::Candidate Reclusterer::best_swap(const LevelGraph& graph, Index node, double least_benefit) {
  Candidate best{least_benefit, kNone, kNone};
  const Index from = hierarchy_.parent[node];
  Index seen[8];
  unsigned seen_count = 0;
  for (const Index n : graph.around(node)) {
    const Index to = hierarchy_.parent[n];
    if (to == from || std::find(seen, seen + seen_count, to) != seen + seen_count) continue;
    if (seen_count < std::size(seen)) seen[seen_count++] = to;
    const double b = benefit(node, to);
    if (b > best.benefit && is_valid_(graph, node, to)) best = {b, node, to};
  }
  return best;
}

// The members of a cluster and what stands around them are worth another look.
void Reclusterer::touch(const LevelGraph& graph, Index cluster) {
  const auto add = [this](Index node) {
    if (mark_[node] == pass_) return;
    mark_[node] = pass_;
    pending_.push_back(node);
  };
  for (Index child = children_.first_child(cluster); child != kNone; child = children_.next_sibling(child)) {
    add(child);
    for (const Index n : graph.around(child)) add(n);
  }
}

void Reclusterer::apply(const LevelGraph& graph, Index node, Index to) {
  Index from = hierarchy_.parent[node];
  children_.move(node, from, to);
  hierarchy_.parent[node] = to;
  touch(graph, from);
  touch(graph, to);
  for (; from != to && from != kNone; from = hierarchy_.parent[from], to = hierarchy_.parent[to]) {
    quadrics_[from] -= quadrics_[node];
    quadrics_[to] += quadrics_[node];
    place(from);
    place(to);
  }
}

void Reclusterer::improve_level(Index level, double threshold) {
  const LevelGraph& graph = graphs_[level];
  // At least so much that rounding alone does not look like a benefit, on flat surfaces too.
  const double least =
      (std::max(threshold, 1e-6) * total_error(level + 1) + kRounding) / hierarchy_.level_size(level + 1);
  pending_.resize(graph.size());
  for (Index i = 0; i < graph.size(); ++i) pending_[i] = graph.first_node + i;
  while (!pending_.empty()) {
    candidates_.clear();
    for (const Index node : pending_)
      if (const Candidate c = best_swap(graph, node, least); c.node != kNone) candidates_.push_back(c);
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      return a.benefit != b.benefit ? a.benefit > b.benefit : a.node < b.node;
    });
    pending_.clear();
    ++pass_;
    for (const Candidate& c : candidates_) {
      // Swaps made since may have taken the benefit away or made another target better; then the next pass decides.
      if (const bool untouched = mark_[c.node] != pass_; !untouched && benefit(c.node, c.to) < 0.5 * c.benefit)
        continue;
      if (is_valid_(graph, c.node, c.to)) apply(graph, c.node, c.to);
    }
  }
}

std::span<const Swap> Reclusterer::step(std::span<const Vec3f> positions) {
  assert(positions.size() == hierarchy_.vertex_count());
  const Index vertex_count = hierarchy_.vertex_count();
  Normalization frame = normalization(positions);
  if (first_) scale_ = frame.scale;
  frame.scale = scale_;
  for (Index v = 0; v < vertex_count; ++v) minima_[v] = frame.to_unit(positions[v]);
  vertex_quadrics_.compute(std::span(minima_).first(vertex_count), std::span(quadrics_).first(vertex_count));
  place_all();

  if (first_) {
    growth_ = options_.growth.value_or(fitted_growth());
    for (Index level = 2; level < hierarchy_.level_count(); ++level) {
      const double ratio = static_cast<double>(hierarchy_.level_size(level)) / hierarchy_.level_size(level - 1);
      level_weight_[level] = options_.coarser_weight * portable_exp(growth_ * portable_log(ratio));
    }
  }
  parents_before_ = hierarchy_.parent;
  for (Index level = 1; level < graphs_.size(); ++level)
    graph_builder_.build_coarser(hierarchy_, level, graphs_[level - 1], graphs_[level]);
  for (auto level = static_cast<Index>(graphs_.size()); level-- > 0;)
    improve_level(level, first_ ? 0.0 : options_.threshold);
  place_all();
  fitted_energies_ = energies_;
  fit_.fit(vertex_quadrics_.areas(), quadrics_, options_.fit, minima_, fitted_energies_);
  first_ = false;

  swaps_.clear();
  for (Index node = 0; node < hierarchy_.node_count(); ++node)
    if (hierarchy_.parent[node] != parents_before_[node]) swaps_.push_back({node, hierarchy_.parent[node]});
  std::copy(positions.begin(), positions.end(), positions_.begin());
  const double unit_error = 1 / (scale_ * scale_);
  for (Index node = vertex_count; node < hierarchy_.node_count(); ++node) {
    positions_[node] = frame.from_unit(minima_[node]);
    errors_[node] = static_cast<float>(std::sqrt(fitted_energies_[node]) * unit_error);
  }
  return swaps_;
}

}  // namespace limber
