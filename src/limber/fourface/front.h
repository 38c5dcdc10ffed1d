// SPDX-License-Identifier: Apache-2.0
// Selective refinement: a mesh of a 4-K mesh that is finer in some places than in others, and moves.
//
// A front is a set of operations that holds all those that its members depend on, by the triangles that it leaves.
// Every front is a conforming mesh. It knows which operations can be applied to it or reversed next, so that moving it
// costs time in proportion to their number and to what changes, not to the size of the 4-K mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/contract/fetch.h"
#include "limber/fourface/four_k_mesh.h"

namespace limber {

// What a budget counts.
enum class FrontBudget { kTriangles, kVertices };

class Front {
 public:
  // The coarsest mesh. `mesh` must outlive the front.
  explicit Front(const FourKMesh& mesh);

  // Moves to where exactly the operations are applied for which is_coarse(operation) holds. Precondition: is_coarse is
  // monotone: where it holds for an operation it does for all that this one depends on.
  template <class IsCoarse>
  void move(const IsCoarse& is_coarse);

  // Applies operations in the order of value(operation), least first, equal ones in their own order, until at most so
  // many triangles, or vertices, are left: no fewer operations, and no more, whatever the front was before.
  // Precondition: value is monotone: not less than that of any operation that this one depends on.
  template <class Value>
  void move_to_budget(const Value& value, Index budget, FrontBudget unit = FrontBudget::kTriangles);

  // Whether an operation was applied when remember() was called last; that of an operation that this one depends on is
  // never false where this one's is true, whatever has moved since.
  void remember() { remembered_ = applied_; }
  bool was_applied(Index operation) const { return remembered_[operation] != 0; }

  bool is_applied(Index operation) const { return applied_[operation] != 0; }

  // Of the front's triangles.
  Index vertex_count() const { return vertex_count_; }

  // Numbers of triangles of the 4-K mesh, in no particular order.
  std::span<const Index> triangles() const { return alive_; }
  bool is_alive(Index triangle) const { return place_[triangle] != kNone; }

  // The corners of the triangles, in the order of triangles().
  void list(std::vector<Triangle>& corners) const;

  // Operations applied and reversed by the last move.
  Index changes() const { return changes_; }

 private:
  using Key = std::pair<double, Index>;  // of the operation that is the second

  bool can_apply(Index operation) const {
    const std::span<const Index> destroyed = mesh_->destroyed_by(operation);
    return std::all_of(destroyed.begin(), destroyed.end(), [this](Index t) { return is_alive(t); });
  }
  bool can_reverse(Index operation) const {
    const Index end = mesh_->created_begin[operation + 1];
    for (Index t = mesh_->created_begin[operation]; t < end; ++t)
      if (!is_alive(t)) return false;
    return true;
  }
  // visit(operation) for each that can be applied or reversed as the front is now, once.
  template <class Visit>
  void for_each_candidate(const Visit& visit) const;
  // The operation is a candidate or is none, as its triangles are now.
  void update(Index operation);
  void update_around(Index operation);
  void apply(Index operation);
  void reverse(Index operation);
  void add(Index triangle);
  void remove(Index triangle);
  Index size(FrontBudget unit) const {
    return unit == FrontBudget::kVertices ? vertex_count_ : static_cast<Index>(alive_.size());
  }
  Index gain(Index operation, FrontBudget unit) const {
    if (unit == FrontBudget::kVertices) return mesh_->is_removal(operation) ? 1 : 0;
    return static_cast<Index>(mesh_->destroyed_by(operation).size()) - mesh_->created_count(operation);
  }
  // Takes what is out of date from the front of a heap; whether anything is left.
  template <class Less, class IsCurrent>
  static bool settle(std::vector<Key>& heap, const Less& less, const IsCurrent& is_current);

  const FourKMesh* mesh_;
  std::vector<Index> alive_;            // [triangles of the front]
  std::vector<Index> place_;            // [mesh.triangle_count()]: in alive_; kNone for those that are not there
  std::vector<Index> candidates_;       // operations that can be applied or reversed
  std::vector<Index> candidate_place_;  // [mesh.operation_count()]: in candidates_; kNone for those that are not there
  std::vector<std::uint8_t> applied_;   // [mesh.operation_count()]
  std::vector<std::uint8_t> remembered_;    // [mesh.operation_count()]: as it was then
  std::vector<Index> visit_;                // scratch
  std::vector<Key> to_apply_, to_reverse_;  // scratch: heaps
  Index vertex_count_ = 0;
  Index changes_ = 0;
};

template <class Visit>
void Front::for_each_candidate(const Visit& visit) const {
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    if (i + kAhead < candidates_.size()) {
      const Index later = candidates_[i + kAhead];
      fetch(&mesh_->vertex[later]), fetch(&mesh_->error[later]), fetch(&mesh_->radius[later]);
    }
    visit(candidates_[i]);
  }
}

template <class IsCoarse>
void Front::move(const IsCoarse& is_coarse) {
  changes_ = 0;
  visit_.clear();
  for_each_candidate([&](Index operation) {
    if (is_coarse(operation) != is_applied(operation)) visit_.push_back(operation);
  });
  while (!visit_.empty()) {
    const Index operation = visit_.back();
    visit_.pop_back();
    if (can_reverse(operation)) {
      if (is_coarse(operation)) continue;
      reverse(operation);
      for (const Index t : mesh_->destroyed_by(operation))
        if (mesh_->creator[t] != kNone) visit_.push_back(mesh_->creator[t]);
    } else if (can_apply(operation) && is_coarse(operation)) {
      apply(operation);
      for (Index t = mesh_->created_begin[operation]; t < mesh_->created_begin[operation + 1]; ++t)
        if (mesh_->destroyer[t] != kNone) visit_.push_back(mesh_->destroyer[t]);
    }
  }
}

template <class Less, class IsCurrent>
bool Front::settle(std::vector<Key>& heap, const Less& less, const IsCurrent& is_current) {
  while (!heap.empty() && !is_current(heap.front().second)) {
    std::pop_heap(heap.begin(), heap.end(), less);
    heap.pop_back();
  }
  return !heap.empty();
}

template <class Value>
void Front::move_to_budget(const Value& value, Index budget, FrontBudget unit) {
  changes_ = 0;
  const auto first_last = [](const Key& a, const Key& b) { return a > b; };  // the least key at the front of a heap
  const auto last_last = [](const Key& a, const Key& b) { return a < b; };
  const auto offer_to_apply = [&](Index operation) {
    if (operation == kNone || !can_apply(operation)) return;
    to_apply_.push_back({value(operation), operation});
    std::push_heap(to_apply_.begin(), to_apply_.end(), first_last);
  };
  const auto offer_to_reverse = [&](Index operation) {
    if (operation == kNone || !can_reverse(operation)) return;
    to_reverse_.push_back({value(operation), operation});
    std::push_heap(to_reverse_.begin(), to_reverse_.end(), last_last);
  };
  to_apply_.clear(), to_reverse_.clear();
  for_each_candidate([&](Index operation) {
    (is_applied(operation) ? to_reverse_ : to_apply_).push_back({value(operation), operation});
  });
  std::make_heap(to_apply_.begin(), to_apply_.end(), first_last);
  std::make_heap(to_reverse_.begin(), to_reverse_.end(), last_last);

  for (;;) {
    const bool coarser = settle(to_apply_, first_last, [this](Index o) { return can_apply(o); });
    const bool finer = settle(to_reverse_, last_last, [this](Index o) { return can_reverse(o); });
    if (size(unit) > budget) {
      if (!coarser) return;
      const Index o = to_apply_.front().second;
      apply(o);
      offer_to_reverse(o);
      for (Index c = mesh_->created_begin[o]; c < mesh_->created_begin[o + 1]; ++c) offer_to_apply(mesh_->destroyer[c]);
      continue;
    }
    if (!finer) return;
    const bool disordered = coarser && to_apply_.front() < to_reverse_.front();
    const Index o = to_reverse_.front().second;
    if (!disordered && size(unit) + gain(o, unit) > budget) return;
    reverse(o);
    offer_to_apply(o);
    for (const Index d : mesh_->destroyed_by(o)) offer_to_reverse(mesh_->creator[d]);
  }
}

}  // namespace limber
