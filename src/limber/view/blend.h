// SPDX-License-Identifier: Apache-2.0
// Geomorphs (Hoppe, "Progressive meshes", 1996, section 3.2) between the frames of a clip: what goes from one active
// node to another gets there over a few frames. Part of the player: standard library only.
//
//   a finest vertex v whose label becomes b in place of a, with options.frames = 3:
//
//   frame            t - 1        t        t + 1      t + 2
//   v is drawn as      a          m          m          b        m: a moving vertex beside the nodes
//   m stands at                a--m--b    a---m-b                1/3 and 2/3 of the way, wherever a and b are by then
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/base/vec.h"
#include "limber/hierarchy/hierarchy.h"
#include "limber/stream/frame_state.h"
#include "limber/view/cut.h"

namespace limber {

struct BlendOptions {
  Index frames = 4;  // that a change takes; with 0 and 1 changes are shown at once
};

// A cut labels every finest vertex with its active node. Those that go together from a label a to a label b, because
// they moved or because nodes were expanded or contracted, are drawn as a moving vertex of their own until they arrive.
// In the k-th of N frames it stands at (1 - k/N) x_a + k/N x_b, with x_a and x_b of that frame. At k = 0 the surface
// would be that of the labels before, at k = N it is that of the labels now, and in between an image of the same finest
// mesh, without cracks. What turns off on its way goes on from where it stands: from a mean of nodes, whose weights it
// keeps. A node that lost all it stood for, and whose number may stand for something else by now, is replaced by where
// it was, carried along by one of the finest vertices that move. Where the triangles would be the same with the group
// at its new label as at its old one, as where a swap only moves the border between two clusters, it is there at once.
//
// A blend shows more vertices than a vertex budget allows the cut: on a galloping horse of 800, a tenth more at N = 4.
class Blend {
 public:
  // `hierarchy` is any frame's of the clip: level sizes do not change. Precondition: mesh and hierarchy are those of
  // all frames and cuts to come.
  Blend(const Mesh& mesh, const Hierarchy& hierarchy, const BlendOptions& options = {});

  const BlendOptions& options() const { return options_; }

  // Makes the blend of this frame. Changes are on their way while each frame is the one after the frame before and
  // the cut's options, but for their hysteresis, stay as they are. Where they do not, and where more than half of the
  // finest vertices change their labels at once (a hierarchy that begins anew), the cut is shown as it is. The same
  // frame again, with the same cut, changes nothing. Allocates only where there have not been as many changes before.
  // Precondition: cut.update(mesh, state) was the last call on the cut.
  void update(const FrameState& state, const Cut& cut);

  // [vertex_count]: an active node, or node_count() + i for the moving vertex i. A moving vertex keeps its number until
  // it has arrived; then another may have it.
  std::span<const Index> labels() const { return labels_; }

  // [node_count() + path_count()], of this frame: those of the nodes, then of the moving vertices.
  std::span<const Vec3f> positions() const { return positions_; }

  Index node_count() const { return node_count_; }
  Index path_count() const { return static_cast<Index>(paths_.size()); }  // moving vertices are below it
  Index moving_count() const { return static_cast<Index>(paths_.size() - free_.size()); }

  // What a moving vertex is a mean of. The weights are above 0 and sum to 1.
  struct Share {
    Index node = kNone;
    float weight = 0;
  };
  class Shares {
   public:
    const Share* begin() const { return shares_.data(); }
    const Share* end() const { return shares_.data() + count_; }

   private:
    friend class Blend;
    static constexpr std::size_t kMost = 7;
    std::array<Share, kMost> shares_;
    std::size_t count_ = 0;
  };

  // None where i is not in use. Precondition: i < path_count().
  Shares shares(Index i) const;

  // The node that a moving vertex goes to. Precondition: i < path_count(), and in use.
  Index target(Index i) const { return paths_[i].target; }

 private:
  // A moving vertex. It comes from the mean of `from` plus an offset.
  struct Path {
    Shares from;
    Vec3f offset{};
    Index anchor = kNone;  // a finest vertex among those that move: what carries the offset
    Index target = kNone;
    Index steps = 0;         // frames on the way, this one included
    Index vertex_count = 0;  // finest vertices that it stands for; 0: not in use
  };

  // Of a finest vertex: what it was drawn as in the frame before, and its label now.
  struct Change {
    Index source, target, vertex;
  };

  void show(const FrameState& state, const Cut& cut);
  void find_deaths(const Hierarchy& hierarchy);
  void carry_dead(Path& path);
  void carry(Path& path, std::size_t share);
  bool find_changes(std::span<const Index> labels);
  void list_images(std::span<const Change> group, std::vector<Triangle>& images) const;
  Path path_of(std::span<const Change> group) const;
  void make_room(Path& path);
  void start(std::span<const Change> group);
  void leave(Index label);
  void go_on();
  void place(const FrameState& state);
  float left(const Path& path) const;
  static void add(Shares& shares, Share share);

  BlendOptions options_;
  Index node_count_;
  std::uint32_t frame_ = kNone;  // that is shown; kNone before the first
  CutOptions cut_options_;       // of it

  // The other two corners of the triangles around every finest vertex: links_[link_begin_[v]] on.
  std::vector<Index> link_begin_;  // [vertex_count + 1]
  std::vector<std::array<Index, 2>> links_;

  std::vector<Index> labels_;     // [vertex_count]
  std::vector<Index> targets_;    // [vertex_count]: the cut's labels
  std::vector<Vec3f> positions_;  // [node_count + path_count]
  std::vector<Path> paths_;
  std::vector<Index> free_;  // paths that are not in use

  std::vector<Index> parents_;                        // [node_count], of the frame shown
  std::vector<std::uint32_t> child_count_;            // [node_count], of the frame shown
  std::vector<std::uint8_t> is_dead_;                 // [node_count]: none of its finest vertices stayed in this frame
  std::vector<Index> dead_, moved_;                   // scratch
  std::vector<Change> changes_;                       // scratch
  std::vector<Triangle> images_before_, images_now_;  // scratch
};

}  // namespace limber
