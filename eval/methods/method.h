// SPDX-License-Identifier: Apache-2.0
// Simplification methods under one signature, so that they can be measured side by side on the same clip.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"
#include "limber/contract/contract.h"
#include "limber/hierarchy/recluster.h"

namespace limber::eval {

// Of Zhang & Wu's method (feature.cpp).
struct FeatureOptions {
  double deformation = 0.5;     // k1: how much edges are spared whose cost changes over the frames, >= 0; the paper's 1
  double feature = 1;           // k2: how much border, sharp and complex edges are spared, >= 0; the paper's 0 to 1
  double sharp_angle = 60;      // an edge is sharp where its triangles meet at less than so many degrees, 0 to 180
  double unified_share = 0.96;  // P: the share of the contractions that all frames have in common, 0 to 1
  bool literal = false;         // the formulas as printed; see feature_weight.h and feature_quadrics.h
  bool memory = true;           // a frame's own contractions prefer the clusters of the frame before
};

struct MethodOptions {
  // How large an approximation may be; one of the two, > 0, the other 0. Isolated vertices do not count.
  Index vertices = 0;
  Index triangles = 0;
  ContractOptions contract{};  // its topology is that of every method but peers

  // Of the multilevel method: as BuildOptions and ReclusterOptions, and `limber build`. Where no level sizes are
  // given a vertex count is the exact size of a level, and the levels around it are spaced as `branching` says.
  double branching = 8;
  std::vector<Index> level_sizes{};
  ReclusterOptions recluster{};  // its topology and quadrics are those of `contract`
  Index blend = 0;  // over how many frames a change is blended (limber/view/blend.h), beyond the size asked for

  FeatureOptions feature{};

  // Of t-dag: what a contraction costs of its price that leads to a node of the frame before, above 0, at most 1; with
  // 1 every frame goes by itself.
  double history = 0.6;
};

// One frame's result. The caller's object, used again for each frame.
struct Approximation {
  std::vector<Triangle> triangles;
  std::vector<Vec3f> positions;  // only vertices that a triangle uses
  std::vector<Index> nodes;      // [positions.size()]: the id of each vertex, the same in every frame
  std::vector<Index> clusters;   // [vertex_count of the clip]: vertices with the same number share a cluster;
                                 // numbers are below the clip's node count, whatever the method's nodes are. Empty
                                 // where the method does not tell
  std::size_t choice_bytes = 0;  // what the frame's own choices of connectivity take when stored; 0: not known
  double adapt_seconds = 0;      // processor time of deciding what the frame is made of ...
  double extract_seconds = 0;    // ... and of listing its vertices and triangles
};

// Follows a clip frame by frame.
class Method {
 public:
  virtual ~Method() = default;

  // Called once, before frame(). `seen`: what the method's MethodInfo::sees says, at least one frame, the first of them
  // the first frame of the clip; each [mesh.vertex_count], finite. The mesh must outlive the method, the frames need
  // not.
  virtual void begin(const Mesh& mesh, std::span<const std::span<const Vec3f>> seen) = 0;

  // The next frame, the first of the clip being the first: [vertex_count], finite.
  virtual void frame(std::span<const Vec3f> positions, Approximation& out) = 0;
};

// Which frames of the clip a method looks at before it begins (seen_frames.h).
enum class Sees {
  kFirst,  // the first alone
  kBase,   // as many as a hierarchy is made for, spread evenly
  kMany,   // all, or as many as a bounded memory holds, spread evenly
};

struct MethodInfo {
  std::string_view name;
  std::string_view description;  // one line
  bool frames_are_independent;   // a frame depends on its positions alone: any may be made without the others
  Sees sees;
  std::unique_ptr<Method> (*create)(const MethodOptions&);
  bool peer = false;  // another project's, which limber was built with (eval/peers/peers.h)

  // Null: it takes every mesh.
  Result<void> (*check)(const Mesh&) = nullptr;

  // Whether begin() may be called for the mesh. Error kBadInput: the place in the mesh, and why not.
  Result<void> supports(const Mesh& mesh) const { return check == nullptr ? Result<void>{} : check(mesh); }
};

// All methods, in the order in which a help text lists them: ours, then peers.
std::span<const MethodInfo> methods();

// Nothing where no method has the name.
const MethodInfo* find_method(std::string_view name);

// The names of the triangles' corners that ChangedTriangles wants.
void name_corners(const Approximation& approximation, std::vector<Triangle>& ids);

}  // namespace limber::eval
