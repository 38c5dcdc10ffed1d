// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/traversal.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace limber {
namespace {

constexpr std::size_t kMostCounted = 7;

// Far corners are searched among this many triangles of a vertex at most: fans of any size cost linear time.
constexpr std::size_t kMostSearched = 16;

struct Queue {
  std::vector<Index> vertices;
  std::size_t front = 0;
};

void order_vertices(Traversal& traversal, const IndexLists& neighbors) {
  const auto vertex_count = static_cast<Index>(neighbors.begin.size() - 1);
  traversal.order.reserve(vertex_count);
  traversal.place.assign(vertex_count, kNone);
  std::vector<std::uint8_t> placed_neighbors(vertex_count, 0);
  std::array<Queue, kMostCounted + 1> queues;  // a vertex is valid only in the queue of its current count

  const auto take_from_queues = [&]() -> Index {
    for (std::size_t count = kMostCounted; count > 0; --count) {
      Queue& queue = queues[count];
      while (queue.front < queue.vertices.size()) {
        const Index v = queue.vertices[queue.front++];
        if (traversal.place[v] == kNone && placed_neighbors[v] == count) return v;
      }
    }
    return kNone;
  };

  Index lowest = 0;
  while (traversal.order.size() < vertex_count) {
    Index v = take_from_queues();
    if (v == kNone) {
      while (traversal.place[lowest] != kNone) ++lowest;
      v = lowest;
    }
    traversal.place[v] = static_cast<Index>(traversal.order.size());
    traversal.order.push_back(v);
    for (const Index u : neighbors[v]) {
      if (traversal.place[u] != kNone || placed_neighbors[u] == kMostCounted) continue;
      queues[++placed_neighbors[u]].vertices.push_back(u);
    }
  }
}

// The parallelogram a + b - far; corners as slots in the list of sources.
struct Parallelogram {
  std::size_t a, b, far;
};

class SourceFinder {
 public:
  SourceFinder(const Mesh& mesh, const IndexLists& incident, const IndexLists& neighbors, Traversal& traversal)
      : mesh_(mesh), incident_(incident), neighbors_(neighbors), traversal_(traversal) {}

  void add_place(Index place) {
    place_ = place;
    count_ = parallelogram_count_ = 0;
    const Index v = traversal_.order[place];
    for (const Index u : neighbors_[v]) {
      if (count_ == kMostSources) break;
      if (traversal_.place[u] < place) sources_[count_++] = traversal_.place[u];
    }
    const std::size_t ring_count = count_;
    const auto incident = incident_[v];
    for (const Index t : incident.first(std::min(incident.size(), kMostSearched))) add_far_corners(t, v, ring_count);
    if (count_ == 0 && place > 0) sources_[count_++] = place - 1;
    write(ring_count);
  }

 private:
  // Where triangle t has, beside v, two placed corners: the parallelograms over the edge between them.
  void add_far_corners(Index t, Index v, std::size_t ring_count) {
    Index edge[2];
    std::size_t corner_count = 0;
    for (const Index u : mesh_.triangles[t])
      if (u != v && traversal_.place[u] < place_ && corner_count < 2) edge[corner_count++] = u;
    if (corner_count < 2 || edge[0] == edge[1]) return;
    const std::size_t a = slot_of(traversal_.place[edge[0]], ring_count);
    const std::size_t b = slot_of(traversal_.place[edge[1]], ring_count);
    if (a == ring_count || b == ring_count) return;
    if (incident_[edge[0]].size() > incident_[edge[1]].size()) std::swap(edge[0], edge[1]);
    const auto across = incident_[edge[0]];
    for (const Index s : across.first(std::min(across.size(), kMostSearched))) {
      const auto& corners = mesh_.triangles[s];
      if (std::find(corners.begin(), corners.end(), edge[1]) == corners.end()) continue;
      for (const Index far : corners) {
        const Index far_place = traversal_.place[far];
        if (far == edge[0] || far == edge[1] || far_place >= place_) continue;
        std::size_t slot = slot_of(far_place, count_);
        if (slot == count_) {
          if (count_ == kMostSources) continue;
          sources_[count_++] = far_place;
        }
        if (parallelogram_count_ < parallelograms_.size()) parallelograms_[parallelogram_count_++] = {a, b, slot};
      }
    }
  }

  std::size_t slot_of(Index place, std::size_t end) const {
    std::size_t slot = 0;
    while (slot < end && sources_[slot] != place) ++slot;
    return slot;
  }

  // The mean of the parallelograms; without any, the mean of the ring.
  void write(std::size_t ring_count) {
    std::array<int, kMostSources> weights{};
    constexpr int kOne = 1 << kWeightBits;
    const auto parallelogram_count = static_cast<int>(parallelogram_count_);
    for (std::size_t i = 0; i < parallelogram_count_; ++i) {
      weights[parallelograms_[i].a] += kOne / parallelogram_count;
      weights[parallelograms_[i].b] += kOne / parallelogram_count;
      weights[parallelograms_[i].far] -= kOne / parallelogram_count;
    }
    if (parallelogram_count == 0)
      for (std::size_t i = 0; i < ring_count; ++i) weights[i] = kOne / static_cast<int>(ring_count);
    int rest = kOne;
    for (const int weight : weights) rest -= weight;
    weights[0] += rest;
    for (std::size_t i = 0; i < count_; ++i) {
      traversal_.sources.data.push_back(sources_[i]);
      traversal_.key_weights.push_back(static_cast<std::int16_t>(weights[i]));
    }
    traversal_.sources.begin.push_back(static_cast<Index>(traversal_.sources.data.size()));
  }

  const Mesh& mesh_;
  const IndexLists& incident_;
  const IndexLists& neighbors_;
  Traversal& traversal_;
  Index place_ = 0;
  std::array<Index, kMostSources> sources_{};
  std::size_t count_ = 0;
  std::array<Parallelogram, 4> parallelograms_{};
  std::size_t parallelogram_count_ = 0;
};

}  // namespace

Traversal traverse(const Mesh& mesh, const IndexLists& incident, const IndexLists& neighbors) {
  Traversal traversal;
  order_vertices(traversal, neighbors);
  traversal.sources.begin.push_back(0);
  SourceFinder finder(mesh, incident, neighbors, traversal);
  for (Index place = 0; place < mesh.vertex_count; ++place) finder.add_place(place);
  return traversal;
}

}  // namespace limber
