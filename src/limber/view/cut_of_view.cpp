// SPDX-License-Identifier: Apache-2.0
// The part of a cut that looks (Hoppe 1997, Luebke and Erikson 1997). Theirs visit the nodes at the border of the cut
// and decide by bounds of each; here, as in cut.cpp, flat passes over all nodes make the cut of the frame, and what is
// promised is not left to bounds of nodes, which know nothing of the triangles between them, but measured:
//
//   weigh every finest vertex, estimate every node            SeenWeights, NodeErrors
//   expand what is estimated to be beyond the limit             expand_by_seen_error
//   find a witness for every finest vertex                                 Witnesses
//   while some have none: expand nodes around them, look again                  hold
#include <algorithm>
#include <cassert>
#include <cmath>

#include "limber/view/cut.h"

namespace limber {

namespace {

// How far the samples that are looked at may be, for what lies between them not to be beyond the bound.
constexpr float kHeld = 0.5f;

constexpr float kLeastLimit = 1e-6f;

float largest(std::span<const float> values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

void Cut::expand_by_seen_error(float limit) {
  const float square = limit * limit, kept_square = square / options_.hysteresis;  // at most square
  const float* errors = looking_->errors.squares().data();
  std::uint8_t* expanded = expanded_.data();
  for (std::size_t n = 0; n < expanded_.size(); ++n) {
    const bool is_beyond = errors[n] > square, stays = errors[n] > kept_square;
    expanded[n] = static_cast<std::uint8_t>(is_beyond | (expanded[n] & stays));
  }
}

// The coarsest nodes around the vertex, its own first: where that is fine and its neighbours are not, they are to
// blame.
bool Cut::expand_around(const Mesh& mesh, const Hierarchy& hierarchy, Index vertex) {
  const Index base = hierarchy.vertex_count();
  Index coarsest = labels_[vertex];
  Index next_level = coarsest < base ? base : hierarchy.level_begin[hierarchy.level_of(coarsest) + 1];
  for (const Index face : looking_->stars.of(vertex)) {
    for (const Index neighbor : mesh.triangles[face]) {
      if (labels_[neighbor] < next_level) continue;
      coarsest = labels_[neighbor];
      next_level = hierarchy.level_begin[hierarchy.level_of(coarsest) + 1];
    }
  }
  if (coarsest < base) return false;
  expanded_[coarsest - base] = 1;
  looking_->errors.learn(coarsest - base, looking_->witnesses.squared_bounds()[vertex]);
  return true;
}

void Cut::relabel_vertices(const Hierarchy& hierarchy) {
  const Index base = hierarchy.vertex_count();
  std::vector<std::uint8_t>& has_changed = looking_->has_changed;
  for (Index v = 0; v < base; ++v) {
    has_changed[v] = labels_[v] >= base && expanded_[labels_[v] - base];
    if (!has_changed[v]) continue;
    Index n = v;
    while (!expanded_[hierarchy.parent[n] - base]) n = hierarchy.parent[n];
    labels_[v] = n;
  }
}

void Cut::hold(const Mesh& mesh, const FrameState& state, float limit) {
  auto& [stars, weights, errors, witnesses, drawn_witnesses, has_changed, seen_error] = *looking_;
  const DrawnSurface drawn{state.positions, labels_, weights.weights()};
  witnesses.find(mesh, stars, drawn, limit);
  drawn_witnesses.begin();
  std::span<const std::uint8_t> changed;  // at first all
  for (;;) {
    witnesses.find_for_sides(mesh, stars, drawn, limit, changed);
    drawn_witnesses.find(mesh, stars, drawn, errors.weights(), limit, changed);
    bool expands = false;
    for (const auto& [node, square] : drawn_witnesses.failing()) {
      expanded_[node - mesh.vertex_count] = 1;
      errors.learn(node - mesh.vertex_count, square);
      expands = true;
    }
    for (const Index v : witnesses.failing()) expands |= expand_around(mesh, state.hierarchy, v);
    if (!expands) break;
    relabel_vertices(state.hierarchy);
    changed = has_changed;
    witnesses.find_again(mesh, stars, drawn, limit, has_changed);
  }
  if (!changed.empty()) label_nodes(state.hierarchy);
  seen_error = std::sqrt(std::max({largest(witnesses.squared_bounds()), witnesses.largest_side_square(),
                                   drawn_witnesses.largest_square()})) /
               kHeld;
}

float Cut::seen_error() const {
  assert(looking_);
  return looking_->seen_error;
}

void Cut::update(const Mesh& mesh, const FrameState& state, const View& view) {
  assert(labels_.size() == state.hierarchy.node_count() && state.errors.size() == labels_.size());
  assert(mesh.vertex_count == has_surface_.size());
  if (!looking_) looking_.emplace(mesh, state.hierarchy);
  const float asked = options_.by == CutBy::kError ? options_.error_bound : std::max(options_.enough, 1.0f);
  const bool holds = options_.by == CutBy::kError && options_.hold;
  const float limit = (holds ? kHeld : 1) * std::max(asked, kLeastLimit);
  looking_->weights.measure(mesh, std::span(state.positions).first(mesh.vertex_count), view, limit, holds);
  looking_->errors.estimate(mesh, state, looking_->weights.weights());
  count_children(state.hierarchy);
  switch (options_.by) {
    case CutBy::kLevel:
      expand_down_to_level(state.hierarchy);
      break;
    case CutBy::kVertices:
    case CutBy::kTriangles: {
      const bool by_vertices = options_.by == CutBy::kVertices;
      const std::uint32_t left = by_vertices ? price_vertices(state.hierarchy) : price_triangles(mesh, state.hierarchy);
      budget_.choose_worst_first(state.hierarchy, {looking_->errors.squares(), price_, left},
                                 options_.enough * options_.enough, options_.hysteresis, expanded_);
      break;
    }
    case CutBy::kError:
      expand_by_seen_error(limit);
      break;
  }
  label_nodes(state.hierarchy);
  if (holds) {
    hold(mesh, state, limit);
  } else {
    const std::span<const float> errors = looking_->errors.squares();
    float most = 0;
    for (Index n = 0; n < errors.size(); ++n)
      most = std::max(most, labels_[mesh.vertex_count + n] == mesh.vertex_count + n ? errors[n] : 0);
    looking_->seen_error = std::sqrt(most);
  }
  count_vertices(state.hierarchy);
}

}  // namespace limber
