// SPDX-License-Identifier: Apache-2.0
// Of Zhang & Wu 2007 this has only that the rest of each frame is stored; the code is ours.
//
//   clusters of a frame  <->  edges of a spanning forest
//   write:  of the forest before, which edges now lie between two clusters
//           of the other edges, those taken, in order, that join two trees of one cluster
//   Both as gaps in their list, from which an edge is left out that cannot come, with models that learn over the
//   frames.
#include "eval/methods/feature_suffix.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "limber/stream/range_coder.h"

namespace limber::eval {

struct SuffixCode::Models {
  NumberModel lost_count, lost_gap, added_count, added_gap;
};

SuffixCode::SuffixCode(const Mesh& mesh)
    : edges_(find_edges(mesh)), parent_(mesh.vertex_count), models_(std::make_unique<Models>()) {}
SuffixCode::~SuffixCode() = default;
SuffixCode::SuffixCode(SuffixCode&&) noexcept = default;
SuffixCode& SuffixCode::operator=(SuffixCode&&) noexcept = default;

Index SuffixCode::root(Index v) {
  while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
  return v;
}

// The least vertex of a tree is its root.
bool SuffixCode::join(Index edge) {
  const Index a = root(edges_.ends[edge][0]), b = root(edges_.ends[edge][1]);
  if (a == b) return false;
  parent_[std::max(a, b)] = std::min(a, b);
  return true;
}

template <class Coder>
void SuffixCode::code(Coder& coder, std::span<const Index> clusters) {
  const auto is_within = [&](Index e) { return clusters[edges_.ends[e][0]] == clusters[edges_.ends[e][1]]; };
  std::vector<std::uint32_t> gaps;
  const auto code_gaps = [&](NumberModel& count_model, NumberModel& gap_model) {
    const std::uint32_t count = count_model.code(coder, static_cast<std::uint32_t>(gaps.size()));
    gaps.resize(std::min<std::size_t>(count, edges_.ends.size()));
    for (std::uint32_t& gap : gaps) gap = gap_model.code(coder, gap);
  };

  if constexpr (Coder::kEncodes) {
    std::uint32_t gap = 0;
    for (const Index e : kept_) {
      if (is_within(e))
        ++gap;
      else
        gaps.push_back(std::exchange(gap, 0));
    }
  }
  code_gaps(models_->lost_count, models_->lost_gap);
  std::size_t kept_count = 0, at = 0;
  for (const std::uint32_t gap : gaps) {
    for (std::uint32_t i = 0; i < gap && at < kept_.size(); ++i) kept_[kept_count++] = kept_[at++];
    at = std::min(at + 1, kept_.size());
  }
  while (at < kept_.size()) kept_[kept_count++] = kept_[at++];
  kept_.resize(kept_count);

  const auto plant = [&] {
    std::iota(parent_.begin(), parent_.end(), Index{0});
    for (const Index e : kept_) join(e);
  };
  gaps.clear();
  if constexpr (Coder::kEncodes) {
    plant();
    std::uint32_t gap = 0;
    for (Index e = 0; e < edges_.ends.size(); ++e) {
      if (root(edges_.ends[e][0]) == root(edges_.ends[e][1])) continue;
      if (is_within(e)) {
        join(e);
        gaps.push_back(std::exchange(gap, 0));
      } else {
        ++gap;
      }
    }
  }
  code_gaps(models_->added_count, models_->added_gap);
  plant();
  auto next = gaps.begin();
  std::uint32_t gap = 0;
  for (Index e = 0; e < edges_.ends.size() && next != gaps.end(); ++e) {
    if (root(edges_.ends[e][0]) == root(edges_.ends[e][1])) continue;
    if (gap++ < *next) continue;
    join(e);
    kept_.push_back(e);
    ++next;
    gap = 0;
  }
  std::ranges::sort(kept_);
}

std::vector<std::byte> SuffixCode::encode(std::span<const Index> clusters) {
  RangeEncoder coder;
  code(coder, clusters);
  return coder.finish();
}

void SuffixCode::decode(std::span<const std::byte> bytes, std::span<Index> clusters) {
  RangeDecoder coder(bytes);
  code(coder, clusters);
  for (Index v = 0; v < clusters.size(); ++v) clusters[v] = root(v);
}

}  // namespace limber::eval
