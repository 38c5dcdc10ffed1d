// SPDX-License-Identifier: Apache-2.0
// Velho 2001, "Measuring Error with Quadrics" and "Simplify Clusters"; docs/design.md, "Four-face clusters", says where
// this differs and why.
//
//   plan_cluster(v):
//     spokes = the edges around v; those of a line are never swapped              (find_sides)
//     for each neighbour u, cheapest C(u) = (Q_v + Q_u)(u) first, while it can be best   (find_best)
//       until four neighbours are left (on a line: one on each of its sides)      (reduce)
//         swap the cheapest edge (v, r) that is legal, r != u, into (s, t); dearer on faces of many operations
//       w = the neighbour across from u; (u, w) must be legal                     (finish)
//       E = alpha C(u) + beta sum of the swaps; keep the least
#include "limber/fourface/cluster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace limber {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kMostKept = 3;  // neighbours that are tried

using Place = std::uint8_t;
template <class T>
using PerNeighbour = std::array<T, Star::kMostNeighbours>;
constexpr Place kNoPlace = 0xff;
constexpr std::uint8_t kOnLine = 2;  // for a side

// The ring while its vertices are swapped away: a list of places, and what each swap would cost now, kNever where it
// may not be.
struct Ring {
  PerNeighbour<Place> previous, next;
  PerNeighbour<double> swap_cost;
  PerNeighbour<std::uint16_t> operations;  // of the face between a neighbour and the next: in a row, until it is there
  std::array<std::uint32_t, 2> left;       // neighbours on each side that have not been swapped away
};

// A Vec3d that is not set to 0 when a plan begins, as most of an array for all possible neighbours is never used.
struct Offset {
  double x, y, z;
  operator Vec3d() const { return {x, y, z}; }
};

// A triangle's area as a share of the largest that the sum of its squared edges allows.
double shape(double doubled_area, double squares) {
  constexpr double kEquilateral = 3.4641016151377544;  // sqrt(12)
  return squares > 0 ? kEquilateral * doubled_area / squares : 0;
}

// A neighbour u that may be kept, and alpha C(u).
struct Candidate {
  double cost;
  Place place;
};

class Planner {
 public:
  Planner(const ClusterInput& input, const Star& star, const ClusterOptions& options)
      : input_(input), star_(star), options_(options) {}

  bool run(bool check_edges, ClusterPlan& best) {
    if (!find_sides()) return false;
    start_ring();
    find_candidates();
    return find_best(check_edges, best);
  }

 private:
  bool has_line() const { return line_[0] != kNoPlace; }
  // The sum of cost(offsets of a frame's neighbours from v) over all frames; kNever where it is that in one.
  template <class Cost>
  double in_all_frames(const Cost& cost) const {
    double sum = cost(offset_);
    for (std::size_t f = 1; f < frame_count_ && sum < kNever; ++f) sum += cost(offset_ + f * Star::kMostNeighbours);
    return sum;
  }
  bool is_reduced(const Ring& ring) const { return ring.left[0] <= needed_[0] && ring.left[1] <= needed_[1]; }
  bool joined(Place a, Place b) const { return input_.faces.has_edge(star_.ring[a], star_.ring[b]); }

  bool find_sides();
  void start_ring();
  void price(Ring& ring, Place r) const {
    ring.swap_cost[r] = side_[r] == kOnLine ? kNever : swap_cost(r, ring.previous[r], ring.next[r]);
  }
  double swap_cost(Place r, Place s, Place t) const {
    return in_all_frames([&](const Offset* at) { return swap_cost(at[r], at[s], at[t]); });
  }
  double swap_cost(const Vec3d& pr, const Vec3d& ps, const Vec3d& pt) const;
  void find_candidates();
  bool find_best(bool check_edges, ClusterPlan& best);
  void copy_ring(Ring& ring) const;
  // Of the two faces that swapping the edge to the neighbour at r destroys, the most.
  static std::uint16_t operations_below(const Ring& ring, std::uint32_t r) {
    return std::max(ring.operations[ring.previous[r]], ring.operations[r]);
  }
  std::uint16_t operations_of_removal(const Ring& ring, Place kept) const;
  double reduce(Ring& ring, Place kept, bool check_edges, ClusterPlan& plan) const;
  double finish(const Ring& ring, Place kept, bool check_edges, ClusterPlan& plan) const;
  double finish_three(const Ring& ring, Place u) const;
  bool faces_outwards(Index a, Index b, Index c) const {
    return options_.fold_over_cosine <= -1 || input_.errors.faces_outwards(a, b, c);
  }
  double triangle_cost(Place u, Place s, Place w) const {
    if (!faces_outwards(star_.ring[u], star_.ring[s], star_.ring[w])) return kNever;
    return in_all_frames([&](const Offset* at) { return triangle_cost(at[u], at[s], at[w]); });
  }
  double triangle_cost(const Vec3d& pu, const Vec3d& ps, const Vec3d& pw) const;
  double fold_over_of_three(const Vec3d& pu, const Vec3d& ps, const Vec3d& pt) const;

  const ClusterInput& input_;
  const Star& star_;
  const ClusterOptions& options_;

  std::size_t frame_count_ = input_.errors.frame_count();
  PerNeighbour<Offset> first_offsets_;  // where there is one frame
  std::vector<Offset> offsets_;         // [kMostNeighbours x frame_count_] where there are more
  const Offset* offset_ = nullptr;      // of the neighbours from v: those of the first frame, of the next ...
  PerNeighbour<std::uint8_t> side_;     // 0, 1 or kOnLine: never swapped
  std::array<Place, 2> line_{kNoPlace, kNoPlace};  // the neighbours on the line through v
  std::array<std::uint32_t, 2> needed_{};          // neighbours of each side that stay
  Ring whole_;
  std::uint16_t least_operations_ = 0;
  std::array<Candidate, kMostKept> candidates_;  // [candidate_count_], cheapest first, then by place
  std::uint32_t candidate_count_ = 0;
};

// False where v has to stay.
bool Planner::find_sides() {
  if (star_.count < 3) return false;
  std::uint32_t lines = 0;
  for (std::uint32_t i = 0; i < star_.face_count(); ++i) {
    if (!input_.faces.is_line(star_.spoke[i])) continue;
    if (lines < 2) line_[lines] = static_cast<Place>(i);
    ++lines;
  }
  if (!star_.closed) {
    // The first spoke is a border edge, and so is the one that ends the last face.
    if (lines != 1) return false;
    line_[1] = static_cast<Place>(star_.count - 1);
    whole_.left = {star_.count - 2, 0};
    needed_ = {1, 0};
  } else if (lines == 0) {
    whole_.left = {star_.count, 0};
    needed_ = {4, 0};
  } else {
    if (lines != 2) return false;
    const std::uint32_t between = line_[1] - line_[0] - 1u;
    whole_.left = {between, star_.count - 2 - between};
    needed_ = {1, 1};
    if (whole_.left[0] < 1 || whole_.left[1] < 1) return false;
  }
  for (std::uint32_t i = 0; i < star_.count; ++i)
    side_[i] = star_.closed && has_line() && (i < line_[0] || i > line_[1]) ? 1 : 0;
  if (has_line()) side_[line_[0]] = side_[line_[1]] = kOnLine;
  return true;
}

void Planner::start_ring() {
  const std::span<const Vec3d> positions = input_.errors.positions();
  if (frame_count_ > 1) offsets_.resize(Star::kMostNeighbours * frame_count_);
  Offset* const offsets = frame_count_ > 1 ? offsets_.data() : first_offsets_.data();
  offset_ = offsets;
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Vec3d center = positions[star_.center * frame_count_ + f];
    for (std::uint32_t i = 0; i < star_.count; ++i) {
      const Vec3d offset = positions[star_.ring[i] * frame_count_ + f] - center;
      offsets[f * Star::kMostNeighbours + i] = {offset.x, offset.y, offset.z};
    }
  }
  for (std::uint32_t i = 0; i < star_.count; ++i) {
    whole_.previous[i] = static_cast<Place>(i == 0 ? star_.count - 1 : i - 1);
    whole_.next[i] = static_cast<Place>(i + 1 == star_.count ? 0 : i + 1);
    whole_.operations[i] = 0;
  }
  least_operations_ = 0xffff;
  for (std::uint32_t i = 0; i < star_.face_count(); ++i) {
    whole_.operations[i] = input_.faces.face(FaceTable::face_of(star_.spoke[i])).operations;
    least_operations_ = std::min(least_operations_, whole_.operations[i]);
  }
  if (is_reduced(whole_)) return;
  for (std::uint32_t i = 0; i < star_.count; ++i) price(whole_, static_cast<Place>(i));
}

// What swapping the edge to the neighbour at r costs, between the neighbours at s and t.
double Planner::swap_cost(const Vec3d& pr, const Vec3d& ps, const Vec3d& pt) const {
  const Vec3d inner = cross(ps, pt);
  const Vec3d both = cross(ps, pr) + cross(pr, pt);
  const Vec3d released = both - inner;
  const double squared = squared_length(both), size = std::sqrt(squared);
  const double released_area = length(released);
  const double least = options_.fold_over_cosine * size;
  if (!(dot(inner, both) > least * length(inner)) || !(dot(released, both) > least * released_area)) return kNever;
  // Six times the volume of (v, r, s, t): the distance between the diagonals times twice the area of the quad.
  const double volume = dot(pr, inner);
  const double squares = squared_length(pr - ps) + squared_length(pt - pr) + squared_length(pt - ps);
  return options_.swap_weight * volume * volume / (18 * size) +
         options_.shape_weight * squared * (1 - shape(released_area, squares));
}

void Planner::find_candidates() {
  const auto add = [&](Place place) {
    const double removal = input_.errors.removal_cost(star_.center, star_.ring[place]);
    const Candidate added{options_.removal_weight * removal, place};
    if (candidate_count_ < kMostKept)
      ++candidate_count_;
    else if (added.cost >= candidates_[kMostKept - 1].cost)
      return;
    std::uint32_t at = candidate_count_ - 1;
    for (; at > 0 && added.cost < candidates_[at - 1].cost; --at) candidates_[at] = candidates_[at - 1];
    candidates_[at] = added;
  };
  if (has_line()) {
    for (const Place i : line_) add(i);
  } else {
    for (std::uint32_t i = 0; i < star_.count; ++i) add(static_cast<Place>(i));
  }
}

bool Planner::find_best(bool check_edges, ClusterPlan& best) {
  double least = kNever;
  ClusterPlan plan;
  Ring ring;
  for (std::uint32_t i = 0; i < candidate_count_; ++i) {
    const auto [removal, kept] = candidates_[i];
    if (removal >= least) break;
    copy_ring(ring);
    plan.swap_count = 0;
    double cost = removal + reduce(ring, kept, check_edges, plan);
    if (cost >= least) continue;
    cost += finish(ring, kept, check_edges, plan);
    if (cost >= least) continue;
    least = cost;
    plan.operations = operations_of_removal(ring, kept);
    best = plan;
  }
  best.cost = static_cast<float>(least);
  return least < kNever;
}

void Planner::copy_ring(Ring& ring) const {
  for (std::uint32_t i = 0; i < star_.count; ++i) {
    ring.previous[i] = whole_.previous[i];
    ring.next[i] = whole_.next[i];
    ring.swap_cost[i] = whole_.swap_cost[i];
    ring.operations[i] = whole_.operations[i];
  }
  ring.left = whole_.left;
}

// Swaps neighbours away, never `kept`, until each side has as many as needed. Gives the costs; kNever where it fails.
double Planner::reduce(Ring& ring, Place kept, bool check_edges, ClusterPlan& plan) const {
  double sum = 0;
  while (!is_reduced(ring)) {
    if (plan.swap_count == ClusterPlan::kMostSwaps) return kNever;
    ring.swap_cost[kept] = kNever;
    std::uint32_t best = kNoPlace;
    double least = kNever;
    for (std::uint32_t i = 0; i < star_.count; ++i) {
      if (!(ring.swap_cost[i] < least) || ring.left[side_[i]] <= needed_[side_[i]]) continue;
      const double cost =
          ring.swap_cost[i] * (1 + options_.chain_weight * (operations_below(ring, i) - least_operations_));
      if (cost < least) least = cost, best = i;
    }
    if (best == kNoPlace) return kNever;
    const auto r = static_cast<Place>(best);
    const Place s = ring.previous[r], t = ring.next[r];
    ring.swap_cost[r] = kNever;
    if (check_edges && joined(s, t)) continue;
    if (!faces_outwards(star_.center, star_.ring[s], star_.ring[t]) ||
        !faces_outwards(star_.ring[s], star_.ring[r], star_.ring[t]))
      continue;
    sum += least;
    ring.operations[s] = static_cast<std::uint16_t>(operations_below(ring, r) + 1);
    plan.swaps[plan.swap_count++] = r;
    --ring.left[side_[r]];
    ring.next[s] = t, ring.previous[t] = s;
    if (!is_reduced(ring)) price(ring, s), price(ring, t);
  }
  return sum;
}

// In a row, with the removal itself.
std::uint16_t Planner::operations_of_removal(const Ring& ring, Place kept) const {
  std::uint16_t most = 0;
  Place i = kept;
  do {
    most = std::max(most, ring.operations[i]);
    i = ring.next[i];
  } while (i != kept);
  return static_cast<std::uint16_t>(most + 1);
}

// The removal itself, with `kept` for u.
double Planner::finish(const Ring& ring, Place u, bool check_edges, ClusterPlan& plan) const {
  plan.kept = plan.opposite = u;
  if (star_.closed && star_.count == 3) return finish_three(ring, u);
  if (!star_.closed) {
    plan.opposite = u == line_[0] ? line_[1] : line_[0];
    if (check_edges && joined(line_[0], line_[1])) return kNever;
    return triangle_cost(line_[0], ring.next[line_[0]], line_[1]);
  }
  const Place s = ring.next[u], w = ring.next[s], t = ring.next[w];
  plan.opposite = w;
  if (check_edges && joined(u, w)) return kNever;
  return triangle_cost(u, s, w) + triangle_cost(w, t, u);
}

double Planner::finish_three(const Ring& ring, Place u) const {
  if (has_line()) return kNever;
  // On a tetrahedron the triangle is there already.
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Index across = input_.faces.twin(FaceTable::next(star_.spoke[i]));
    if (across != kNone && input_.faces.origin(FaceTable::previous(across)) == star_.ring[(i + 2) % 3]) return kNever;
  }
  const Place s = ring.next[u], t = ring.next[s];
  if (!faces_outwards(star_.ring[u], star_.ring[s], star_.ring[t])) return kNever;
  return in_all_frames([&](const Offset* at) { return fold_over_of_three(at[u], at[s], at[t]); });
}

// 0, or kNever where one of the three triangles around v turns too far.
double Planner::fold_over_of_three(const Vec3d& pu, const Vec3d& ps, const Vec3d& pt) const {
  const Vec3d after = cross(ps - pu, pt - pu);
  const double least = options_.fold_over_cosine * length(after);
  for (const Vec3d& before : {cross(pu, ps), cross(ps, pt), cross(pt, pu)})
    if (!(dot(before, after) > least * length(before))) return kNever;
  return 0;
}

// Of the triangle (u, s, w) in the place of (v, u, s) and (v, s, w); kNever where it folds over.
double Planner::triangle_cost(const Vec3d& pu, const Vec3d& ps, const Vec3d& pw) const {
  const Vec3d before = cross(pu, ps) + cross(ps, pw);
  const Vec3d after = before + cross(pw, pu);
  const double squared = squared_length(before), area = length(after);
  if (!(dot(before, after) > options_.fold_over_cosine * std::sqrt(squared) * area)) return kNever;
  const double squares = squared_length(ps - pu) + squared_length(pw - ps) + squared_length(pu - pw);
  return options_.shape_weight * squared * (1 - shape(area, squares));
}

}  // namespace

bool plan_cluster(const ClusterInput& input, const Star& star, const ClusterOptions& options, bool check_edges,
                  ClusterPlan& plan) {
  return Planner(input, star, options).run(check_edges, plan);
}

bool creates_new_edges(const FaceTable& faces, const Star& star, const ClusterPlan& plan) {
  const auto joined = [&](std::uint32_t a, std::uint32_t b) { return faces.has_edge(star.ring[a], star.ring[b]); };
  std::uint64_t gone = 0;
  const auto step = [&](std::uint32_t i, std::uint32_t by) {
    do i = (i + by) % star.count;
    while (gone >> i & 1);
    return i;
  };
  for (std::uint32_t i = 0; i < plan.swap_count; ++i) {
    const std::uint32_t r = plan.swaps[i];
    gone |= std::uint64_t{1} << r;
    if (joined(step(r, star.count - 1), step(r, 1))) return false;
  }
  return plan.kept == plan.opposite || !joined(plan.kept, plan.opposite);
}

}  // namespace limber
