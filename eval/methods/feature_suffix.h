// SPDX-License-Identifier: Apache-2.0
// The contractions that a frame adds to those of all frames (Zhang & Wu 2007, section 3.3), as few bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "limber/base/mesh.h"
#include "limber/contract/edges.h"

namespace limber::eval {

// A frame's clusters are kept as the edges of the mesh that hold them together, a spanning tree for each; written is
// how these differ from the edges of the frame before. Writing and reading go through the same steps, so that one
// object does the one or the other, frame after frame, starting from a frame in which every vertex is by itself.
class SuffixCode {
 public:
  explicit SuffixCode(const Mesh& mesh);
  ~SuffixCode();
  SuffixCode(SuffixCode&&) noexcept;
  SuffixCode& operator=(SuffixCode&&) noexcept;

  // clusters: [vertex_count]; vertices with the same number share a cluster, and are joined by edges within it.
  std::vector<std::byte> encode(std::span<const Index> clusters);

  // clusters: [vertex_count], overwritten: the least vertex of each one's cluster. Of bytes that encode() did not write
  // some clusters come out, joined by edges too.
  void decode(std::span<const std::byte> bytes, std::span<Index> clusters);

 private:
  struct Models;
  template <class Coder>
  void code(Coder& coder, std::span<const Index> clusters);
  Index root(Index v);
  bool join(Index edge);

  Edges edges_;
  std::vector<Index> kept_;    // the edges of the frame before that hold clusters together, ascending
  std::vector<Index> parent_;  // [vertex_count], of union-find: scratch
  std::unique_ptr<Models> models_;
};

}  // namespace limber::eval
