// SPDX-License-Identifier: Apache-2.0
// Edge contraction, whatever the costs and the placement: what is asked for, and what it has come to.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/contract/cost_queue.h"
#include "limber/contract/edges.h"
#include "limber/contract/spatial_order.h"
#include "limber/contract/surface.h"
#include "limber/contract/vertex_quadrics.h"

namespace limber {

enum class Topology {
  kPreserve,  // every contraction obeys the link condition: the result is homeomorphic to the input
  kFree,      // holes may close, necks and fins may collapse; components are never joined
};

// How the costs of an edge in several frames become one.
enum class FrameCost {
  kSum,      // Mohr & Gleicher 2003
  kLargest,  // Kircher & Garland 2005, section 6
};

// What a contraction costs, and where it puts its vertex.
enum class Placement {
  kQuadric,  // Garland & Heckbert 1997: least squared distance to the planes of the input (Contractor)
  kVolume,  // Lindstrom & Turk 1998: least squared volume between the surface as it is before and after, and least area
            // along its borders and sharp edges (VolumeContractor). One frame; closer to the surface, and slower
};

struct ContractOptions {
  Topology topology = Topology::kPreserve;
  QuadricOptions quadrics;
  // A contraction is put off while it would turn the normal of a triangle beyond the angle with this cosine, -1 to 1.
  double fold_over_cosine = 0.2;
  FrameCost frame_cost = FrameCost::kSum;
  Placement placement = Placement::kQuadric;  // kVolume looks at `topology` alone
};

// Asked now and then by what takes long; false: stop. Quick, and without an effect on the result.
using GoOnFunction = std::function<bool()>;

// A mesh that is being contracted, and can be asked for smaller and smaller vertex counts. Isolated vertices stay and
// do not count.
class Contraction {
 public:
  virtual ~Contraction() = default;

  // Contracts until at most `target` vertices are left that are not isolated, or no legal contraction remains; gives
  // the number left. Contractions put off for what they would do to the shape are made when nothing else is left.
  virtual Index contract_to(Index target) = 0;

  // Whether go_on has given false: nothing more is contracted from then on, and nothing else may be asked.
  bool is_cancelled() const { return is_cancelled_; }

  Index vertex_count() const { return surface_.vertex_count(); }

  // The vertex that stands for v now; itself if it has not been contracted.
  Index representative(Index v) const;

  // Where a representative lies in a frame; up to the rounding of single precision the input's position of a vertex
  // that nothing was contracted into.
  virtual Vec3f position(Index representative, std::size_t frame) const = 0;

 protected:
  explicit Contraction(GoOnFunction go_on) : go_on_(std::move(go_on)) {}
  Contraction(Contraction&&) = default;
  Contraction& operator=(Contraction&&) = default;

  static constexpr Index kStepsUnasked = 1024;

  // Asks go_on_ after so many steps.
  bool goes_on(Index steps = 1) {
    if (!go_on_ || (steps_ += steps) < kStepsUnasked) return !is_cancelled_;
    steps_ = 0;
    is_cancelled_ = is_cancelled_ || !go_on_();
    return !is_cancelled_;
  }

  // Takes over the mesh, its vertices in spatial order; gives it as it is by place, and its edges. Both are empty
  // where it was cancelled.
  struct Placed {
    Mesh mesh;
    Edges edges;
  };
  Placed adopt(const Mesh& mesh, std::span<const Vec3f> positions);

  enum class EdgeState : std::uint8_t {
    kPriced,  // in the queue under its cost
    kStale,   // in the queue under a cost from before its surroundings changed
    kPutOff,  // refused as its surroundings are now; not in the queue
    kGone,    // no longer there, whether in the queue or not
  };

  // Begins the queue with all edges. price(edge): what its contraction costs now.
  template <class Price>
  void start_queue(const Price& price) {
    queue_ = CostQueue(surface_.edge_count());
    state_.resize(surface_.edge_count());
    for (Index e = 0; e < surface_.edge_count() && goes_on(); ++e) enqueue(e, price(e));
  }

  void enqueue(Index edge, float cost) {
    state_[edge] = EdgeState::kPriced;
    queue_.push(edge, cost);
  }

  // contract_to(), the cheapest edge first. attempt(edge): contracts it, or gives false where it must be put off; what
  // check_fold_over_ asks for is up to it. fetch_early, fetch_soon: as of CostQueue::advance(); fetch_ahead(): before
  // an edge that has come to the front is looked at.
  template <class Price, class FetchEarly, class FetchSoon, class FetchAhead, class Attempt>
  Index contract_cheapest(Index target, const Price& price, const FetchEarly& fetch_early, const FetchSoon& fetch_soon,
                          const FetchAhead& fetch_ahead, const Attempt& attempt) {
    bool progress = true;
    const auto reprice = [&](Index edge, float old_cost) {
      if (state_[edge] == EdgeState::kGone) return -1.0f;
      if (state_[edge] == EdgeState::kPriced) return old_cost;
      if (!goes_on()) return -1.0f;
      state_[edge] = EdgeState::kPriced;
      return price(edge);
    };
    while (surface_.vertex_count() > target && goes_on()) {
      if (!queue_.advance(reprice, fetch_early, fetch_soon)) {
        if (!progress && !check_fold_over_) break;
        check_fold_over_ = progress && check_fold_over_;
        progress = false;
        for (Index e = 0; e < surface_.edge_count(); ++e)
          if (state_[e] == EdgeState::kPutOff) enqueue(e, price(e));
        if (!queue_.advance(reprice, fetch_early, fetch_soon)) break;
      }
      const Index edge = queue_.front();
      queue_.pop();
      fetch_ahead();
      if (state_[edge] == EdgeState::kGone) continue;
      if (state_[edge] == EdgeState::kStale) {
        enqueue(edge, price(edge));
        continue;
      }
      if (attempt(edge))
        progress = true;
      else
        state_[edge] = EdgeState::kPutOff;
    }
    shorten_chains();
    return surface_.vertex_count();
  }

  std::vector<Index> order_;   // [vertex_count]: the input's vertex at each place; all below is by place
  std::vector<Index> places_;  // [vertex_count]: the inverse
  Surface surface_{Mesh{}};
  std::vector<Index> merged_into_;  // [vertex_count], kNone for representatives
  std::vector<EdgeState> state_;    // [edge_count]
  CostQueue queue_{0};
  bool check_fold_over_ = true;

 private:
  // Lets every vertex lead to its representative at once.
  void shorten_chains();

  GoOnFunction go_on_;
  Index steps_ = 0;  // since go_on_ was asked
  bool is_cancelled_ = false;
};

}  // namespace limber
