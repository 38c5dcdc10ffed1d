// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, sections 4.1 to 4.3 and 5. Differences: docs/design.md, "Reclustering".
//
//   step(positions):
//     quadrics of the finest vertices, summed up the levels; minima and errors of all nodes      section 3
//     for each level, coarse to fine: improve_level()                                             section 4.3
//     where the frame is a jump: the same for a hierarchy made anew, which is taken if it is much better
//     sums, minima and errors once more from scratch, so that what is stored does not depend on the order of swaps
//     nodes moved from their minima to where the levels fit the surface                           level_fit.h
//
//   improve_level(level):
//     repeat while enough clusters are born:
//       make_swaps(): repeat until no swap is made
//         for each node whose surroundings have changed: best_swap(), valid and better than the threshold
//         in order of benefit, those that are still valid and better: move
//       births and deaths of clusters                                                             rebirth.h
//     swaps that turn triangles back                                                              unfold.h
//
// What a swap is worth (worth.h) is judged again right before it is made: every swap lowers the weighted error by more
// than the threshold, so this ends.
//
// The graph of a level depends on the levels below it alone, which change after it: it is built once per frame.
#include "limber/hierarchy/recluster.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "limber/base/portable_math.h"
#include "limber/hierarchy/build.h"

namespace limber {
namespace {

constexpr double kPaperGrowth = 1.9127;
constexpr double kLeastGrowth = 1, kMostGrowth = 3;  // beyond, the fit has met something else
constexpr double kRounding = 1e-18;                  // of errors of a surface of unit size
constexpr double kMeantBranching = 8;                // the paper's, for which thresholds are given
constexpr unsigned kMostRounds = 8;                  // of births and deaths on a level in a step

// Of candidates; the same order everywhere.
constexpr auto kMoreBenefit = [](const auto& a, const auto& b) {
  return a.benefit != b.benefit ? a.benefit > b.benefit : a.node != b.node ? a.node < b.node : a.to < b.to;
};

// The geometric mean of a[i] / b[i].
double mean_ratio(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += portable_log((a[i] + kRounding) / (b[i] + kRounding));
  return portable_exp(sum / static_cast<double>(a.size()));
}

}  // namespace

ReclusterOptions recluster_options(Follow follow) {
  ReclusterOptions options;
  switch (follow) {
    case Follow::kCalm:
      options.threshold = 0.2;
      options.rebirth.hysteresis = 3;
      options.restart.gain = 0.7;
      break;
    case Follow::kBalanced:
      break;
    case Follow::kClose:
      options.threshold = 0;
      options.rebirth = {.hysteresis = 1.2, .again = 0};
      break;
    case Follow::kPaper:
      options.benefit = Benefit::kFixed;
      options.rebirth.hysteresis = 0;
      options.restart.jump = 0;
      options.unfold = 0;
      options.fit.rounds = 0;
      break;
  }
  return options;
}

Reclusterer::Reclusterer(const Mesh& mesh, Hierarchy base, const ReclusterOptions& options)
    : mesh_(mesh),
      options_(options),
      clusters_(std::move(base)),
      worth_(clusters_, options.benefit),
      budget_(clusters_.hierarchy()),
      is_valid_(clusters_.hierarchy(), clusters_.children(), options.topology),
      rebirth_(clusters_, is_valid_, worth_, budget_),
      unfolder_(clusters_, is_valid_, worth_, budget_),
      vertex_quadrics_(mesh, options.quadrics),
      graphs_(hierarchy().level_count()),
      positions_(hierarchy().node_count()),
      errors_(hierarchy().node_count(), 0.0f),
      fit_(mesh, clusters_.hierarchy()),
      mark_(hierarchy().node_count(), 0) {
  assert(hierarchy().vertex_count() == mesh.vertex_count);
  graph_builder_.build_finest(mesh, options.topology == Topology::kFree, graphs_[0]);
}

void Reclusterer::measure_leeways(const LeewayOptions& options, std::span<Leeway> leeways) const {
  const Index vertex_count = hierarchy().vertex_count();
  assert(leeways.size() == hierarchy().node_count() - vertex_count);
  for (std::size_t i = 0; i < leeways.size(); ++i) {
    const auto node = static_cast<Index>(vertex_count + i);
    leeways[i] = leeway(clusters_.quadric(node), clusters_.energy(node), scale_, options);
  }
}

// Of those above the finest.
std::vector<double> Reclusterer::level_errors() const {
  std::vector<double> errors;
  for (Index level = 1; level < hierarchy().level_count(); ++level) errors.push_back(total_error(level));
  return errors;
}

// The slope of log(total error) over log(size), by least squares over the levels above the finest. Levels that the
// topology kept from shrinking say nothing about it.
double Reclusterer::fitted_growth() const {
  double count = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (Index level = 1; level < hierarchy().level_count(); ++level) {
    const double error = total_error(level);
    if (!(error > 0) ||
        5 * std::uint64_t{hierarchy().level_size(level)} > 4 * std::uint64_t{hierarchy().level_size(level - 1)})
      continue;
    const double x = portable_log(hierarchy().level_size(level)), y = portable_log(error);
    count += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread = count * sxx - sx * sx;
  if (count < 2 || !(spread > 0)) return kPaperGrowth;
  const double growth = -(count * sxy - sx * sy) / spread;
  return growth >= kLeastGrowth && growth <= kMostGrowth ? growth : kPaperGrowth;
}

// The valid swap of the node that gains most, and more than the least benefit; none: node is kNone.
Reclusterer::Candidate Reclusterer::best_swap(const LevelGraph& graph, Index node, double least_benefit) {
  const Candidate none{0, kNone, kNone};
  const Index from = clusters_.parent(node);
  if (clusters_.has_one_child(from)) return none;
  targets_.clear();
  Index last = from;
  for (const Index n : graph.around(node)) {
    const Index to = clusters_.parent(n);
    if (to == from || to == last) continue;
    last = to;
    if (std::ranges::find(targets_, to) == targets_.end()) targets_.push_back(to);
  }
  if (targets_.empty()) return none;
  if (!first_) {  // there no estimate keeps a node from being judged
    const double likely = Worth::kLikely * least_benefit;
    const double about_release = worth_.about_release(node);
    if (!(about_release > likely)) return none;
    double least_burden = std::numeric_limits<double>::infinity();
    for (const Index to : targets_)
      least_burden = std::min(least_burden, worth_.about_burden(clusters_.quadric(node), to));
    if (!(about_release - least_burden > likely)) return none;
  }
  worths_.resize(targets_.size());
  worth_.of_swaps(node, targets_, worths_);
  candidates_of_node_.clear();
  for (std::size_t i = 0; i < targets_.size(); ++i)
    if (worths_[i] > least_benefit) candidates_of_node_.push_back({worths_[i], node, targets_[i]});
  std::sort(candidates_of_node_.begin(), candidates_of_node_.end(), kMoreBenefit);
  for (const Candidate& c : candidates_of_node_)
    if (is_valid_(graph, node, c.to)) return c;
  return none;
}

// The members of a cluster and what stands around them are worth another look.
void Reclusterer::touch(const LevelGraph& graph, Index cluster) {
  const auto add = [this](Index node) {
    if (mark_[node] == pass_) return;
    mark_[node] = pass_;
    pending_.push_back(node);
  };
  for (const Index child : clusters_.children().of(cluster)) {
    add(child);
    for (const Index n : graph.around(child)) add(n);
  }
}

// Until none is left that gains more than the least benefit.
void Reclusterer::make_swaps(const LevelGraph& graph, double least_benefit) {
  while (!pending_.empty()) {
    candidates_.clear();
    for (const Index node : pending_)
      if (const Candidate c = best_swap(graph, node, least_benefit); c.node != kNone) candidates_.push_back(c);
    std::sort(candidates_.begin(), candidates_.end(), kMoreBenefit);
    pending_.clear();
    ++pass_;
    for (const Candidate& c : candidates_) {
      // Swaps made since, near or below the same coarser clusters, may have taken the benefit away or made another
      // target better; then the next pass decides. Every swap that is made does lower the error: so this ends.
      if (worth_.of_swap(c.node, c.to) < std::max(0.5 * c.benefit, least_benefit)) continue;
      if (!is_valid_(graph, c.node, c.to)) continue;
      const Index from = clusters_.parent(c.node);
      if (!unfolder_.move(graph, c.node, c.to)) continue;
      touch(graph, from);
      touch(graph, c.to);
    }
  }
}

// Where clusters have few children each takes much of the coarser mesh along when it moves, and many ways to share them
// out are nearly as good: docs/design.md, "Reclustering".
double Reclusterer::threshold_below(Index level) const {
  const double branching = static_cast<double>(hierarchy().level_size(level - 1)) / hierarchy().level_size(level);
  const double fewer = std::max(kMeantBranching / branching, 1.0);
  return options_.threshold * fewer * fewer;
}

void Reclusterer::improve_level(Index level) {
  const LevelGraph &graph = graphs_[level], &coarser = graphs_[level + 1];
  const double threshold = first_ ? 0 : threshold_below(level + 1);
  // At least so much that rounding alone does not look like a benefit, on flat surfaces too.
  const double least =
      (std::max(threshold, 1e-6) * total_error(level + 1) + kRounding) / hierarchy().level_size(level + 1);
  pending_.resize(graph.size());
  for (Index i = 0; i < graph.size(); ++i) pending_[i] = graph.first_node + i;
  const double again = first_ ? 0 : options_.rebirth.again;
  bool is_worth_it = true;
  for (unsigned round = 0;; ++round) {
    make_swaps(graph, least);
    if (round == kMostRounds || !is_worth_it) break;
    const std::vector<Index>& changed = rebirth_.pair_up(graph, coarser, least, options_.rebirth);
    is_worth_it = static_cast<double>(changed.size()) > again * hierarchy().level_size(level + 1);
    ++pass_;
    for (const Index cluster : changed) touch(graph, cluster);
  }
  if (options_.unfold > 0)
    unfolder_.unfold(graph, (options_.unfold * total_error(level + 1) + kRounding) / hierarchy().level_size(level + 1));
}

// Whether to make the frame anew beside following it, before anything is moved; counts the frames to wait.
bool Reclusterer::decide_to_try() {
  const RestartOptions& restart = options_.restart;
  if (graphs_.size() < 2 || !(restart.jump > 0)) return false;
  if (first_) return restart.tries_first;
  if (frames_to_wait_ > 0) --frames_to_wait_;
  const double jump = mean_ratio(level_errors(), errors_before_);
  if (!(jump > restart.jump)) return false;
  if (jump >= restart.certain_jump) return true;
  if (frames_to_wait_ > 0) return false;
  frames_to_wait_ = restart.patience;
  return true;
}

void Reclusterer::try_anew(std::span<const Vec3f> positions) {
  std::optional<Hierarchy> made =
      build_alike(mesh_, positions, hierarchy(), {.topology = options_.topology, .quadrics = options_.quadrics});
  if (!made) return;
  ReclusterOptions options = options_;
  options.growth = growth_;
  options.restart.tries_first = false;
  options.fit.rounds = 0;
  Reclusterer anew(mesh_, std::move(*made), options);
  anew.step(positions);
  std::vector<double> errors = anew.level_errors();
  const double unit = scale_ / anew.scale_, unit_2 = unit * unit;
  for (double& error : errors) error *= unit_2 * unit_2;
  if (!(mean_ratio(errors, level_errors()) < options_.restart.gain)) return;
  clusters_.replace(anew.hierarchy());
  unfolder_.forget();
  has_restarted_ = true;
}

std::span<const Swap> Reclusterer::step(std::span<const Vec3f> positions) {
  assert(positions.size() == hierarchy().vertex_count());
  const Index vertex_count = hierarchy().vertex_count();
  Normalization frame = normalization(positions);
  if (first_) scale_ = frame.scale;
  frame.scale = scale_;
  const std::span<Vec3d> finest = clusters_.finest_positions();
  for (Index v = 0; v < vertex_count; ++v) finest[v] = frame.to_unit(positions[v]);
  vertex_quadrics_.compute(finest, clusters_.finest_quadrics());
  std::ranges::copy(vertex_quadrics_.facings(), clusters_.finest_facings().begin());
  clusters_.weigh();

  if (first_) {
    growth_ = options_.growth.value_or(fitted_growth());
    worth_.set_weights(growth_, options_.coarser_weight);
  }
  const bool may_be_anew = decide_to_try();
  parents_before_ = hierarchy().parent;
  for (Index level = 1; level < graphs_.size(); ++level)
    graph_builder_.build_coarser(hierarchy(), level, graphs_[level - 1], graphs_[level]);
  const bool is_limited = !first_ && options_.most_changed < 1;
  if (is_limited) budget_.limit(graphs_, options_.most_changed);
  for (Index level = hierarchy().level_count() - 1; level-- > 0;) improve_level(level);
  has_restarted_ = false;
  if (may_be_anew && !is_limited) try_anew(positions);
  clusters_.weigh();
  errors_before_ = level_errors();
  fitted_energies_.assign(clusters_.energies().begin(), clusters_.energies().end());
  fit_.fit(clusters_.quadrics(), clusters_.facings(), options_.fit, clusters_.minima(), fitted_energies_);
  first_ = false;

  swaps_.clear();
  for (Index node = 0; node < hierarchy().node_count(); ++node)
    if (hierarchy().parent[node] != parents_before_[node]) swaps_.push_back({node, hierarchy().parent[node]});
  std::copy(positions.begin(), positions.end(), positions_.begin());
  const double unit_error = 1 / (scale_ * scale_);
  for (Index node = vertex_count; node < hierarchy().node_count(); ++node) {
    positions_[node] = frame.from_unit(clusters_.minimum_at(node));
    errors_[node] = static_cast<float>(std::sqrt(fitted_energies_[node]) * unit_error);
  }
  return swaps_;
}

}  // namespace limber
