// SPDX-License-Identifier: Apache-2.0
// Edge contraction under the cost of Zhang & Wu 2007, section 3.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/contract/contract.h"
#include "limber/contract/surface.h"

namespace limber::eval {

// What the summed cost of an edge is multiplied with. It may depend on the edges around its ends.
class EdgeFactor {
 public:
  virtual ~EdgeFactor() = default;

  // >= 0. positions: [vertex_count x frame_count], as contracted so far.
  virtual double factor(Surface& surface, std::span<const Vec3f> positions, Index edge) = 0;

  // Whether nothing but what its ends have taken in changes the factor of an edge.
  virtual bool is_of_ends() const { return false; }

  // `goes` has become a part of `stays`.
  virtual void contracted(Index /*stays*/, Index /*goes*/) {}
};

// Of every vertex in every frame, by vertex.
struct FrameData {
  std::size_t frame_count = 1;
  std::vector<Quadric> quadrics;  // [vertex_count x frame_count]
  std::vector<Vec3f> positions;   // [vertex_count x frame_count]
};

// The cheapest edge first, where an edge costs
//
//   factor x sum over t of c(t)  +  k1 x sum over t of |c(t) - mean of c|
//
// and c(t) is the least value of the sum of its ends' quadrics in frame t. Such a cost may fall when an end takes in
// another vertex, so that the costs are kept up to date, unlike those of Contractor.
class FeatureContraction {
 public:
  struct Merge {
    Index stays, goes;
  };

  // surface: [vertex_count]. `factor` must outlive this object. Topology and fold-over: as Contractor has them,
  // but for a contraction that folds over in a tenth of the frames or fewer, which is not put off.
  FeatureContraction(Surface surface, FrameData data, const ContractOptions& options, double k1, EdgeFactor& factor);

  // Contracts to at most `vertices` vertices with an edge, or to at most `triangles` triangles, the other being 0; or
  // as near as the topology allows.
  void contract_to(Index vertices, Index triangles);

  std::span<const Merge> merges() const { return merges_; }

  // Of a vertex that is still there, in a frame.
  Vec3f position(Index v, std::size_t frame) const { return data_.positions[v * data_.frame_count + frame]; }

 private:
  enum class EdgeState : std::uint8_t {
    kQueued,
    kPutOff,  // refused as its surroundings are now
  };
  struct Entry {
    double price;
    Index edge;
    std::uint32_t version;                                   // an entry whose edge has got another price since is void
    friend bool operator<(const Entry& a, const Entry& b) {  // the front of a heap is its largest
      return a.price != b.price ? a.price > b.price : a.edge > b.edge;
    }
  };

  void measure(Index edge);
  void enqueue(Index edge);
  // The next edge that is there and has this price; kNone where none is left.
  Index take();
  bool folds_over(Index edge);
  void apply(Index edge);

  Surface surface_;
  FrameData data_;
  ContractOptions options_;
  double k1_;
  EdgeFactor& factor_;
  Index triangle_count_ = 0;
  std::vector<Entry> heap_;
  std::vector<double> sums_, deviations_;  // [edge_count]: over the frames
  std::vector<double> prices_;             // [edge_count]: which that of the latest entry may be below
  std::vector<std::uint32_t> versions_;    // [edge_count]
  std::vector<EdgeState> state_;           // [edge_count]
  std::vector<Merge> merges_;
  std::vector<double> costs_;  // [frame_count], scratch, as all that follow
  std::vector<Vec3d> minima_;  // [frame_count]
  std::vector<Index> neighbours_, around_;
  bool check_fold_over_ = true;
};

}  // namespace limber::eval
