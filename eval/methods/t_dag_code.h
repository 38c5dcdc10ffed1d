// SPDX-License-Identifier: Apache-2.0
// What a frame adds to a time-dependent directed acyclic graph (t_dag.cpp), as few bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "eval/methods/t_dag_forest.h"
#include "limber/base/mesh.h"
#include "limber/contract/edges.h"

namespace limber::eval {

// Of the graph only its living part is kept, the hierarchy of the frame before; written is which of its nodes end, and
// which nodes begin. Writing and reading go through the same steps, so that one object does the one or the other, frame
// after frame, starting from a frame in which every vertex is by itself.
class TDagCode {
 public:
  explicit TDagCode(const Mesh& mesh);
  ~TDagCode();
  TDagCode(TDagCode&&) noexcept;
  TDagCode& operator=(TDagCode&&) noexcept;

  // forest: of the mesh's vertices; every node above them has two children, which an edge of the mesh joins.
  std::vector<std::byte> encode(const Forest& forest);

  // living() becomes the hierarchy that was written. Of bytes that encode() did not write some hierarchy comes out, in
  // which a node may have more than two children.
  void decode(std::span<const std::byte> bytes);

  // The nodes that live in the latest frame, whichever way it came; numbered the same by both.
  const Forest& living() const { return living_; }
  // How many of them began with it, and how many ended before it.
  Index born() const { return born_; }
  Index ended() const { return ended_; }

 private:
  struct Models;
  template <class Coder>
  void code(Coder& coder, const Forest* forest);

  Edges edges_;
  Forest living_;
  Index born_ = 0, ended_ = 0;
  std::unique_ptr<Models> models_;
};

}  // namespace limber::eval
