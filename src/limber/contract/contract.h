// SPDX-License-Identifier: Apache-2.0
// Edge contraction under quadric error functions (QSlim: Garland & Heckbert 1997), for one frame or for many frames
// at once (Mohr & Gleicher 2003): simplification, and the clusters that hierarchies are built from.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/contract/cost_queue.h"
#include "limber/contract/edges.h"
#include "limber/contract/fetch.h"
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

struct ContractOptions {
  Topology topology = Topology::kPreserve;
  QuadricOptions quadrics;
  // A contraction is put off while it would turn the normal of a triangle beyond the angle with this cosine, -1 to 1.
  double fold_over_cosine = 0.2;
  FrameCost frame_cost = FrameCost::kSum;
};

// Asked now and then by what takes long; false: stop. Quick, and without an effect on the result.
using GoOnFunction = std::function<bool()>;

// Changes the quadrics of the vertices in a frame, [mesh.vertex_count], before anything is contracted. They are given
// in coordinates normalized by the frame's normalization() with the scale of the first frame's, must stay positive
// definite (see base/quadric.h), and may be replaced altogether.
using ChangeQuadricsFunction = std::function<void(std::size_t frame, std::span<Quadric> quadrics)>;

// Contracts edges, cheapest first, and can be asked for smaller and smaller vertex counts. The cost of an edge in a
// frame is the smallest value of the sum of its ends' quadrics, each frame with a minimum of its own; its cost is the
// sum over the frames, or what options.frame_cost says. Isolated vertices stay and do not count.
class Contractor {
 public:
  // frames: at least one; each [mesh.vertex_count], finite. Neither need live on. go_on is asked here and in
  // contract_to(): before each pass over the mesh, of which a frame takes one, and about every thousand edges.
  Contractor(const Mesh& mesh, std::span<const std::span<const Vec3f>> frames, const ContractOptions& options,
             GoOnFunction go_on = {}, const ChangeQuadricsFunction& change_quadrics = {});

  // Contracts until at most `target` vertices are left that are not isolated, or no legal contraction remains; gives
  // the number left. Contractions put off by the fold-over check are made when nothing else is left.
  Index contract_to(Index target);

  // Whether go_on has given false: nothing more is contracted from then on, and nothing else may be asked.
  bool is_cancelled() const { return is_cancelled_; }

  Index vertex_count() const { return surface_.vertex_count(); }

  // The vertex that stands for v now; itself if it has not been contracted.
  Index representative(Index v) const;

  // Where a representative lies in a frame: the minimum of its quadric, or, up to the rounding of single precision, the
  // input's position of a vertex that nothing was contracted into.
  Vec3f position(Index representative, std::size_t frame) const;

 private:
  enum class EdgeState : std::uint8_t {
    kPriced,  // in the queue under its cost
    kStale,   // in the queue under a cost from before an end took in another vertex
    kPutOff,  // refused as its surroundings are now; not in the queue
    kGone,    // no longer there, whether in the queue or not
  };

  // Asks go_on_ after so many steps.
  bool goes_on(Index steps = 1);
  float cost(Index edge) const;
  void enqueue(Index edge);
  void fetch_quadric(Index v) const {
    const Quadric& quadric = quadrics_[v * frame_count_];
    fetch(&quadric.xx);
    fetch(&quadric.c);
  }
  void fetch_ahead() const;
  void shorten_chains();
  bool folds_over(Index edge);
  void apply(Index edge);

  ContractOptions options_;
  GoOnFunction go_on_;
  Index steps_ = 0;  // since go_on_ was asked
  bool is_cancelled_ = false;
  std::size_t frame_count_;
  std::vector<Index> order_;   // [vertex_count]: the input's vertex at each place; all below is by place
  std::vector<Index> places_;  // [vertex_count]: the inverse
  Surface surface_{Mesh{}};
  std::vector<Normalization> normalizations_;  // [frame_count]
  std::vector<Quadric> quadrics_;              // [vertex_count x frame_count]
  std::vector<Vec3f> positions_;               // [vertex_count x frame_count], normalized; single precision, so that
                                               // more of them are in the cache
  std::vector<Index> merged_into_;             // [vertex_count], kNone for representatives
  std::vector<EdgeState> state_;               // [edge_count]
  std::vector<Vec3d> minima_;                  // [frame_count], scratch
  CostQueue queue_{0};
  bool check_fold_over_ = true;
};

struct Simplified {
  Mesh mesh;                     // only vertices that a triangle uses
  std::vector<Vec3f> positions;  // [mesh.vertex_count]
  std::vector<Index> vertices;   // [mesh.vertex_count]: the representative, an index of the input
};

// One frame to at most `vertex_count` vertices, or as near as the topology allows.
Simplified simplify(const Mesh& mesh, std::span<const Vec3f> positions, Index vertex_count,
                    const ContractOptions& options);

// What a contractor has come to, in one frame.
Simplified simplified_mesh(const Contractor& contractor, const Mesh& mesh, std::size_t frame);

}  // namespace limber
