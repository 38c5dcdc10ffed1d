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
//
// What is computed for several neighbours is computed for two at once (Pair), which the processor does in the time of
// one.
#include "limber/fourface/cluster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "limber/fourface/pair.h"

namespace limber {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kMostKept = 3;  // neighbours that are tried

using Place = std::uint8_t;
template <class T>
using PerNeighbour = std::array<T, Star::kMostNeighbours>;
constexpr Place kNoPlace = 0xff;
constexpr std::uint8_t kOnLine = 2;  // for a side

// Where the neighbours are, from v: of each frame Star::kMostNeighbours of each coordinate.
struct Offsets {
  static constexpr std::size_t kSize = 3 * Star::kMostNeighbours;

  const double* values;

  Vec3d at(Place i) const { return {x()[i], y()[i], z()[i]}; }
  Vec3<Pair> at(Place i, Place j) const { return {Pair{x()[i], x()[j]}, Pair{y()[i], y()[j]}, Pair{z()[i], z()[j]}}; }
  const double* x() const { return values; }
  const double* y() const { return values + Star::kMostNeighbours; }
  const double* z() const { return values + 2 * Star::kMostNeighbours; }
};

struct Neighbour {
  double swap_cost;          // what swapping the edge to it would cost now, kNever where it may not be
  std::uint16_t operations;  // of the face between it and the next: in a row, until it is there
  Place previous, next;
};

// The ring while its vertices are swapped away.
struct Ring {
  PerNeighbour<Neighbour> at;
  std::array<std::uint32_t, 2> left;  // neighbours on each side that have not been swapped away
  std::uint64_t gone;                 // bit i: the one at place i has been
};

// Where reduce() has led to without a neighbour.
struct Reduced {
  Ring ring;
  double cost;
  std::uint8_t swap_count;
  std::array<std::uint8_t, ClusterPlan::kMostSwaps> swaps;
  bool whoever_is_kept;  // it would be the same for every neighbour that is left
};

// 1 less a triangle's area as a share of the largest that the sum of its squared edges allows.
inline Pair shapelessness(Pair doubled_area, Pair squares) {
  constexpr double kEquilateral = 3.4641016151377544;  // sqrt(12)
  return squares > Pair{} ? 1 - kEquilateral * doubled_area / squares : Pair{1, 1};
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

  bool run(ClusterPlan& best) {
    if (!find_sides()) return false;
    start_ring();
    find_candidates();
    return find_best(best);
  }

 private:
  bool has_line() const { return line_[0] != kNoPlace; }
  bool is_reduced(const Ring& ring) const { return ring.left[0] <= needed_[0] && ring.left[1] <= needed_[1]; }
  bool joined(Place a, Place b) const { return input_.faces.has_edge(star_.ring[a], star_.ring[b]); }
  Offsets offsets(std::size_t frame) const { return {offsets_ + frame * Offsets::kSize}; }

  bool find_sides();
  void start_ring();
  void price(Ring& ring, Place a, Place b) const;
  void find_candidates();
  bool find_best(ClusterPlan& best);
  // Of the two faces that swapping the edge to the neighbour at r destroys, the most.
  static std::uint16_t operations_below(const Ring& ring, Place r) {
    return std::max(ring.at[ring.at[r].previous].operations, ring.at[r].operations);
  }
  std::uint16_t operations_of_removal(const Ring& ring, Place kept) const;
  void reduce(Reduced& to, Place kept) const;
  double finish(const Ring& ring, Place kept, Place& opposite) const;
  double finish_three(const Ring& ring, Place u) const;
  bool is_inverted(const std::array<Index, 3>& corners, std::size_t frame, const Vec3d& normal) const {
    return options_.fold_over_cosine > -1 && input_.errors.is_inverted(corners, frame, normal);
  }
  // Whether a triangle of three neighbours faces outwards; one of v and two.
  bool faces_outwards(Place a, Place b, Place c) const;
  bool faces_outwards(Place a, Place b) const;
  double fold_over_of_three(const Vec3d& pu, const Vec3d& ps, const Vec3d& pt) const;
  Pair triangle_costs(const Offsets& at, const std::array<Place, 2>& u, const std::array<Place, 2>& s,
                      const std::array<Place, 2>& w, Vec3<Pair>& after) const;

  const ClusterInput& input_;
  const Star& star_;
  const ClusterOptions& options_;

  std::size_t frame_count_ = input_.errors.frame_count();
  std::array<double, Offsets::kSize> first_offsets_;  // where there is one frame
  std::vector<double> all_offsets_;                   // where there are more
  const double* offsets_ = nullptr;                   // of all frames
  PerNeighbour<std::uint8_t> side_;                   // 0, 1 or kOnLine: never swapped
  std::array<Place, 2> line_{kNoPlace, kNoPlace};     // the neighbours on the line through v
  std::array<std::uint32_t, 2> needed_{};             // neighbours of each side that stay
  Ring whole_;
  Reduced reduced_[2];
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
  if (frame_count_ > 1) all_offsets_.resize(Offsets::kSize * frame_count_);
  double* const offsets = frame_count_ > 1 ? all_offsets_.data() : first_offsets_.data();
  offsets_ = offsets;
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Vec3d center = positions[star_.center * frame_count_ + f];
    double* const x = offsets + f * Offsets::kSize;
    for (std::uint32_t i = 0; i < star_.count; ++i) {
      const Vec3d offset = positions[star_.ring[i] * frame_count_ + f] - center;
      x[i] = offset.x, x[i + Star::kMostNeighbours] = offset.y, x[i + 2 * Star::kMostNeighbours] = offset.z;
    }
  }
  const std::uint32_t last = star_.count - 1;
  least_operations_ = 0xffff;
  for (std::uint32_t i = 0; i <= last; ++i) {
    std::uint16_t operations = 0;
    if (i < star_.face_count()) {
      operations = input_.faces.face(FaceTable::face_of(star_.spoke[i])).operations;
      least_operations_ = std::min(least_operations_, operations);
    }
    whole_.at[i] = {kNever, operations, static_cast<Place>(i == 0 ? last : i - 1),
                    static_cast<Place>(i == last ? 0 : i + 1)};
  }
  whole_.gone = 0;
  if (is_reduced(whole_)) return;
  for (std::uint32_t i = 0; i <= last; i += 2)
    price(whole_, static_cast<Place>(i), static_cast<Place>(std::min(i + 1, last)));
}

// What swapping the edges to two neighbours costs, between those that are beside them now.
void Planner::price(Ring& ring, Place a, Place b) const {
  Neighbour &first = ring.at[a], &second = ring.at[b];
  Pair sum{};
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Offsets at = offsets(f);
    const Vec3<Pair> r = at.at(a, b), s = at.at(first.previous, second.previous), t = at.at(first.next, second.next);
    const Vec3<Pair> inner = cross(s, t);
    const Vec3<Pair> both = cross(s, r) + cross(r, t);
    const Vec3<Pair> released = both - inner;
    const Pair squared = squared_length(both), size = root(squared);
    const Pair inner_size = root(squared_length(inner)), released_size = root(squared_length(released));
    const Pair least = options_.fold_over_cosine * size;
    // Six times the volume of (v, r, s, t): the distance between the diagonals times twice the area of the quad.
    const Pair volume = dot(r, inner);
    const Pair squares = squared_length(r - s) + squared_length(t - r) + squared_length(t - s);
    const Pair cost = options_.swap_weight * volume * volume / (18 * size) +
                      options_.shape_weight * squared * shapelessness(released_size, squares);
    const Pair never{kNever, kNever};
    sum += dot(inner, both) > least * inner_size ? (dot(released, both) > least * released_size ? cost : never) : never;
  }
  const auto put = [&](Neighbour& to, Place r, double cost) {
    const unsigned more = operations_below(ring, r) - least_operations_;
    to.swap_cost = side_[r] == kOnLine ? kNever : cost * (1 + options_.chain_weight * more);
  };
  put(first, a, sum[0]);
  put(second, b, sum[1]);
}

void Planner::find_candidates() {
  PerNeighbour<double> removal;
  input_.errors.removal_costs(star_, removal);
  const auto add = [&](Place place) {
    const Candidate added{options_.removal_weight * removal[place], place};
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

bool Planner::find_best(ClusterPlan& best) {
  double least = kNever;
  reduced_[0].whoever_is_kept = false;
  for (std::uint32_t i = 0; i < candidate_count_; ++i) {
    const auto [removal, kept] = candidates_[i];
    if (removal >= least) break;
    const bool again = reduced_[0].whoever_is_kept && !(reduced_[0].ring.gone >> kept & 1);
    Reduced& reduced = reduced_[!again && reduced_[0].whoever_is_kept];
    if (!again) reduce(reduced, kept);
    double cost = removal + reduced.cost;
    if (cost >= least) continue;
    Place opposite = kept;
    cost += finish(reduced.ring, kept, opposite);
    if (cost >= least) continue;
    least = cost;
    best.kept = kept, best.opposite = opposite;
    best.kept_vertex = star_.ring[kept];
    best.swap_count = reduced.swap_count;
    best.swaps = reduced.swaps;
    best.operations = operations_of_removal(reduced.ring, kept);
  }
  best.cost = static_cast<float>(least);
  return least < kNever;
}

// Swaps neighbours away, never `kept`, until each side has as many as needed. The cost is kNever where it fails.
void Planner::reduce(Reduced& to, Place kept) const {
  Ring& ring = to.ring;
  for (std::uint32_t i = 0; i < star_.count; ++i) ring.at[i] = whole_.at[i];
  ring.left = whole_.left;
  ring.gone = 0;
  to.cost = 0, to.swap_count = 0, to.whoever_is_kept = true;
  while (!is_reduced(ring)) {
    Place r = kNoPlace;
    double least = kNever;
    if (to.swap_count < ClusterPlan::kMostSwaps) {
      for (std::uint32_t i = 0; i < star_.count; ++i) {
        if (!(ring.at[i].swap_cost < least) || i == kept || ring.left[side_[i]] <= needed_[side_[i]]) continue;
        least = ring.at[i].swap_cost, r = static_cast<Place>(i);
      }
    }
    if (ring.at[kept].swap_cost <= least) to.whoever_is_kept = false;
    if (r == kNoPlace) {
      to.cost = kNever;
      return;
    }
    const Place s = ring.at[r].previous, t = ring.at[r].next;
    ring.at[r].swap_cost = kNever;
    if (joined(s, t)) continue;
    if (!faces_outwards(s, t) || !faces_outwards(s, r, t)) continue;
    to.cost += least;
    ring.at[s].operations = static_cast<std::uint16_t>(operations_below(ring, r) + 1);
    to.swaps[to.swap_count++] = r;
    ring.gone |= std::uint64_t{1} << r;
    --ring.left[side_[r]];
    ring.at[s].next = t, ring.at[t].previous = s;
    if (!is_reduced(ring)) price(ring, s, t);
  }
}

bool Planner::faces_outwards(Place a, Place b) const {
  const std::array<Index, 3> corners{star_.center, star_.ring[a], star_.ring[b]};
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Offsets at = offsets(f);
    if (is_inverted(corners, f, cross(at.at(a), at.at(b)))) return false;
  }
  return true;
}

bool Planner::faces_outwards(Place a, Place b, Place c) const {
  const std::array<Index, 3> corners{star_.ring[a], star_.ring[b], star_.ring[c]};
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Offsets at = offsets(f);
    if (is_inverted(corners, f, cross(at.at(b) - at.at(a), at.at(c) - at.at(a)))) return false;
  }
  return true;
}

// In a row, with the removal itself.
std::uint16_t Planner::operations_of_removal(const Ring& ring, Place kept) const {
  std::uint16_t most = 0;
  Place i = kept;
  do {
    most = std::max(most, ring.at[i].operations);
    i = ring.at[i].next;
  } while (i != kept);
  return static_cast<std::uint16_t>(most + 1);
}

// The removal itself, with `kept` for u.
double Planner::finish(const Ring& ring, Place u, Place& opposite) const {
  if (star_.closed && star_.count == 3) return finish_three(ring, u);
  if (!star_.closed) u = line_[0];
  const Place s = ring.at[u].next, w = ring.at[s].next, t = star_.closed ? ring.at[w].next : s;
  opposite = opposite == w ? u : w;
  if (joined(u, w)) return kNever;
  // At a border there is but one triangle, which counts once.
  const bool two = star_.closed;
  const std::array<Place, 2> us{u, two ? w : u}, ss{s, t}, ws{w, two ? u : w};
  double sum = 0;
  for (std::size_t f = 0; f < frame_count_; ++f) {
    Vec3<Pair> after;
    const Pair costs = triangle_costs(offsets(f), us, ss, ws, after);
    sum += two ? costs[0] + costs[1] : costs[0];
    if (!(sum < kNever)) return kNever;
    for (std::size_t i = 0; i < 1u + two; ++i) {
      const std::array<Index, 3> corners{star_.ring[us[i]], star_.ring[ss[i]], star_.ring[ws[i]]};
      if (is_inverted(corners, f, {after.x[i], after.y[i], after.z[i]})) return kNever;
    }
  }
  return sum;
}

double Planner::finish_three(const Ring& ring, Place u) const {
  if (has_line()) return kNever;
  // On a tetrahedron the triangle is there already.
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Index across = input_.faces.twin(FaceTable::next(star_.spoke[i]));
    if (across != kNone && input_.faces.origin(FaceTable::previous(across)) == star_.ring[(i + 2) % 3]) return kNever;
  }
  const Place s = ring.at[u].next, t = ring.at[s].next;
  if (!faces_outwards(u, s, t)) return kNever;
  double sum = 0;
  for (std::size_t f = 0; f < frame_count_; ++f) {
    const Offsets at = offsets(f);
    sum += fold_over_of_three(at.at(u), at.at(s), at.at(t));
  }
  return sum;
}

// 0, or kNever where one of the three triangles around v turns too far.
double Planner::fold_over_of_three(const Vec3d& pu, const Vec3d& ps, const Vec3d& pt) const {
  const Vec3d after = cross(ps - pu, pt - pu);
  const double least = options_.fold_over_cosine * length(after);
  for (const Vec3d& before : {cross(pu, ps), cross(ps, pt), cross(pt, pu)})
    if (!(dot(before, after) > least * length(before))) return kNever;
  return 0;
}

// Of the triangles (u, s, w) in the place of (v, u, s) and (v, s, w), whose normals are `after`; kNever where one folds
// over.
Pair Planner::triangle_costs(const Offsets& at, const std::array<Place, 2>& u, const std::array<Place, 2>& s,
                             const std::array<Place, 2>& w, Vec3<Pair>& after) const {
  const Vec3<Pair> pu = at.at(u[0], u[1]), ps = at.at(s[0], s[1]), pw = at.at(w[0], w[1]);
  const Vec3<Pair> before = cross(pu, ps) + cross(ps, pw);
  after = before + cross(pw, pu);
  const Pair squared = squared_length(before), area = root(squared_length(after));
  const Pair squares = squared_length(ps - pu) + squared_length(pw - ps) + squared_length(pu - pw);
  const Pair cost = options_.shape_weight * squared * shapelessness(area, squares);
  return dot(before, after) > options_.fold_over_cosine * root(squared) * area ? cost : Pair{kNever, kNever};
}

}  // namespace

bool plan_cluster(const ClusterInput& input, const Star& star, const ClusterOptions& options, ClusterPlan& plan) {
  return Planner(input, star, options).run(plan);
}

bool creates_new_edges(const FaceTable& faces, const Star& star, const ClusterPlan& plan) {
  const auto joined = [&](std::uint32_t a, std::uint32_t b) { return faces.has_edge(star.ring[a], star.ring[b]); };
  std::uint64_t gone = 0;
  const auto step = [&](std::uint32_t i, std::uint32_t by) {
    do {
      i += by;
      if (i >= star.count) i -= star.count;
    } while (gone >> i & 1);
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
