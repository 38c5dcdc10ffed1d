// SPDX-License-Identifier: Apache-2.0
// A hierarchy that follows a deforming mesh by swaps (Kircher & Garland 2005, sections 4 and 5).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/quadric.h"
#include "limber/base/vec.h"
#include "limber/contract/contract.h"
#include "limber/hierarchy/change_budget.h"
#include "limber/hierarchy/clustering.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/hierarchy/leeway.h"
#include "limber/hierarchy/level_fit.h"
#include "limber/hierarchy/level_graph.h"
#include "limber/hierarchy/rebirth.h"
#include "limber/hierarchy/swap_validity.h"
#include "limber/hierarchy/unfold.h"
#include "limber/hierarchy/worth.h"

namespace limber {

// Where a clip jumps, from one scene or pose to another, a hierarchy made anew for the frame is better than one that
// follows. All shares are geometric means over the levels.
struct RestartOptions {
  // A frame is tried that way where its errors, before anything is moved, are so many times those of the frame before,
  // >= 1; 0: none is.
  double jump = 1.5;
  // Less than so many times may be fast motion, which goes on: then one frame in `patience` is tried.
  double certain_jump = 2.25;
  unsigned patience = 32;
  // What is made anew is taken where it leaves less than this share of the errors that following does, > 0.
  double gain = 0.85;
  // The first frame is tried, too: for where the base hierarchy was made for others beside it.
  bool tries_first = false;
};

struct ReclusterOptions {
  Topology topology = Topology::kPreserve;
  QuadricOptions quadrics;
  // The exponent beta of equation 2: the total error of a level grows as its size to the power of -beta. Fitted to
  // the levels of the first frame where not given; the paper used 1.9127.
  std::optional<double> growth;
  // A factor on the weight of each level against the one below it, beside equation 2, > 0. The paper's is 1; less
  // than that leaves the finer levels more freedom.
  double coarser_weight = 0.2;
  // A swap is worth making when it lowers the weighted error by more than this share of the mean error of the
  // clusters on its level, >= 0: what trades error against changes, time and bytes. Meant for a branching factor of 8;
  // between levels of a smaller one, b, it is (8/b)^2 times as much.
  double threshold = 0.05;
  Benefit benefit = Benefit::kExact;
  // Births and deaths of clusters beside the swaps.
  RebirthOptions rebirth;
  RestartOptions restart;
  // Triangles that face away from the surface are turned back by swaps, each of which may cost so many times the mean
  // error of the clusters on its level, >= 0; 0: none is.
  double unfold = 0.5;
  // From the second frame on, at most this share of the triangles of any level is new, >= 0; 1 and more: no limit. With
  // a limit nothing is made anew but the first frame. It holds for levels; a cut to a size chooses its nodes by itself.
  double most_changed = 1;
  // How the nodes' positions are fitted to the surface; swaps are chosen by quadrics alone.
  FitOptions fit;
};

// How closely a hierarchy follows a clip: docs/design.md, "How closely", has the curve.
enum class Follow {
  kCalm,
  kBalanced,
  kClose,
  kPaper,  // Kircher & Garland's: swaps alone, judged by equation 1, nodes at the minima of their quadrics
};

// The numbers behind the word.
ReclusterOptions recluster_options(Follow follow);

// The options, with the topology and the quadrics by which the base hierarchy was contracted.
inline ReclusterOptions as_contracted(ReclusterOptions options, const ContractOptions& contract) {
  options.topology = contract.topology;
  options.quadrics = contract.quadrics;
  return options;
}

// Follows a clip frame by frame. One frame of memory.
class Reclusterer {
 public:
  // `base` is any valid hierarchy over the mesh (build.h), which must outlive this object.
  Reclusterer(const Mesh& mesh, Hierarchy base, const ReclusterOptions& options);
  Reclusterer(const Reclusterer&) = delete;  // its parts refer to each other
  Reclusterer& operator=(const Reclusterer&) = delete;

  // Adapts the hierarchy to the next frame; positions: [vertex_count], finite. Gives the net parent changes since the
  // frame before, by node; in the first frame, those of the base hierarchy, improved without a threshold. Where the
  // hierarchy has been made anew (has_restarted()), with levels of the same sizes, these are most of its nodes.
  std::span<const Swap> step(std::span<const Vec3f> positions);

  // All of the last step:
  const Hierarchy& hierarchy() const { return clusters_.hierarchy(); }
  // [node_count]; finest nodes have the positions given, others those of level_fit.h.
  std::span<const Vec3f> positions() const { return positions_; }
  // [node_count]; square root of the squared error that the fit leaves, without a fit of the least quadric error; 0 for
  // finest nodes (see stream/frame_state.h for the unit).
  std::span<const float> errors() const { return errors_; }
  // How far each node above the finest level may stand from its position: leeways[node - vertex_count]. In the units of
  // the positions.
  void measure_leeways(const LeewayOptions& options, std::span<Leeway> leeways) const;
  // Sum of the quadric errors of a level, normalized by the frame's diagonal to the fourth power.
  double total_error(Index level) const { return clusters_.total_energy(level); }
  // Whether it made the hierarchy anew, which is improved as the base is. In the first frame, whether the base was
  // left.
  bool has_restarted() const { return has_restarted_; }
  // The exponent in use, after the first step.
  double growth() const { return growth_; }

 private:
  struct Candidate {
    double benefit;
    Index node, to;
  };

  std::vector<double> level_errors() const;
  double fitted_growth() const;
  Candidate best_swap(const LevelGraph& graph, Index node, double least_benefit);
  void make_swaps(const LevelGraph& graph, double least_benefit);
  void touch(const LevelGraph& graph, Index cluster);
  double threshold_below(Index level) const;
  void improve_level(Index level);
  bool decide_to_try();
  void try_anew(std::span<const Vec3f> positions);

  const Mesh& mesh_;
  ReclusterOptions options_;
  Clustering clusters_;
  Worth worth_;
  ChangeBudget budget_;
  SwapValidity is_valid_;
  Rebirth rebirth_;
  Unfolder unfolder_;
  VertexQuadrics vertex_quadrics_;
  LevelGraphBuilder graph_builder_;
  std::vector<LevelGraph> graphs_;  // [level_count]
  double growth_ = 0;
  double scale_ = 0;  // of the first frame's normalization, used for all
  bool first_ = true;
  bool has_restarted_ = false;
  unsigned frames_to_wait_ = 0;        // until another frame is tried that may be fast motion
  std::vector<double> errors_before_;  // level_errors() of the frame before

  std::vector<double> fitted_energies_;  // [node_count], squared errors after the fit
  std::vector<Vec3f> positions_;         // [node_count]
  std::vector<float> errors_;            // [node_count]
  std::vector<Index> parents_before_;    // [node_count]
  std::vector<Swap> swaps_;

  LevelFit fit_;

  std::vector<Index> targets_;                 // scratch of best_swap()
  std::vector<double> worths_;                 // of them
  std::vector<Candidate> candidates_of_node_;  // those worth making
  std::vector<Candidate> candidates_;          // scratch of a pass
  std::vector<Index> pending_;                 // nodes to look at in the next pass
  std::vector<Index> mark_;                    // [node_count]: pending when == pass_
  Index pass_ = 0;
};

}  // namespace limber
