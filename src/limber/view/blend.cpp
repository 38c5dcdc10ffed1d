// SPDX-License-Identifier: Apache-2.0
// Hoppe 1996, section 3.2, moves the vertices of one edge collapse; here whatever has another label than in the frame
// before (docs/design.md, "Playing").
//
//   find_changes                  finest vertices with another label, in groups: from where, to where
//   find_deaths                   nodes of which nothing stayed where it was
//   carry_dead                    what comes from them goes on without them
//   for each group: start         a path, where a triangle changes
//   go_on                         a step on every path; those at the end are left
//   place
#include "limber/view/blend.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

namespace limber {

namespace {

std::vector<Index> begins_of_links(const Mesh& mesh) {
  std::vector<Index> begin(mesh.vertex_count + std::size_t{1}, 0);
  for (const Triangle& t : mesh.triangles) {
    for (const Index corner : t) ++begin[corner + 1];
  }
  for (Index v = 0; v < mesh.vertex_count; ++v) begin[v + 1] += begin[v];
  return begin;
}

// Calls visit(i) where a[i] and b[i] differ, in rising order. Most of them are equal.
template <class Visit>
void for_each_difference(std::span<const Index> a, std::span<const Index> b, Visit&& visit) {
  constexpr std::size_t kBlock = 16;
  for (std::size_t begin = 0; begin < a.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, a.size());
    if (std::equal(a.begin() + static_cast<std::ptrdiff_t>(begin), a.begin() + static_cast<std::ptrdiff_t>(end),
                   b.begin() + static_cast<std::ptrdiff_t>(begin)))
      continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (a[i] != b[i]) visit(static_cast<Index>(i));
    }
  }
}

// With another hysteresis the same level of detail is asked for.
bool is_same(const CutOptions& a, const CutOptions& b) {
  return a.by == b.by && a.level == b.level && a.budget == b.budget && a.error_bound == b.error_bound &&
         a.enough == b.enough;
}

}  // namespace

Blend::Blend(const Mesh& mesh, const Hierarchy& hierarchy, const BlendOptions& options)
    : options_(options),
      node_count_(hierarchy.node_count()),
      link_begin_(begins_of_links(mesh)),
      links_(3 * mesh.triangles.size()),
      child_count_(node_count_),
      is_dead_(node_count_) {
  assert(mesh.vertex_count == hierarchy.vertex_count());
  std::vector<Index> next(link_begin_);
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) links_[next[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
}

void Blend::show(const FrameState& state, const Cut& cut) {
  const Hierarchy& hierarchy = state.hierarchy;
  targets_.assign(cut.labels().begin(), cut.labels().begin() + hierarchy.vertex_count());
  labels_ = targets_;
  positions_.assign(state.positions.begin(), state.positions.end());
  paths_.clear();
  free_.clear();
  if (options_.frames <= 1) return;
  parents_.assign(hierarchy.parent.begin(), hierarchy.parent.end());
  std::fill(child_count_.begin(), child_count_.end(), 0);
  for (const Index parent : parents_) {
    if (parent != kNone) ++child_count_[parent];
  }
}

// A node without children that stayed, or whose children that stayed all died themselves, is dead: what has its number
// now lies elsewhere.
void Blend::find_deaths(const Hierarchy& hierarchy) {
  for (const Index n : dead_) is_dead_[n] = 0;
  dead_.clear();
  moved_.clear();
  const auto lose = [&](Index parent) {
    if (--child_count_[parent] == 0) dead_.push_back(parent);
  };
  for_each_difference(parents_, hierarchy.parent, [&](Index n) {
    moved_.push_back(n);
    lose(parents_[n]);
  });
  const auto stayed_below = [&](Index n) { return parents_[n] != kNone && parents_[n] == hierarchy.parent[n]; };
  for (std::size_t i = 0; i < dead_.size(); ++i) {
    is_dead_[dead_[i]] = 1;
    if (stayed_below(dead_[i])) lose(parents_[dead_[i]]);
  }
  for (const Index n : dead_) {
    if (stayed_below(n)) ++child_count_[parents_[n]];
  }
  for (const Index n : moved_) {
    parents_[n] = hierarchy.parent[n];
    ++child_count_[parents_[n]];
  }
}

void Blend::add(Shares& shares, Share share) {
  for (Share& known : std::span(shares.shares_).first(shares.count_)) {
    if (known.node != share.node) continue;
    known.weight += share.weight;
    return;
  }
  shares.shares_[shares.count_++] = share;
}

// In place of the node, whose position is still that of the frame before: the anchor, and how far off that is.
void Blend::carry(Path& path, std::size_t share) {
  const auto [node, weight] = path.from.shares_[share];
  path.offset += weight * (positions_[node] - positions_[path.anchor]);
  path.from.shares_[share] = path.from.shares_[--path.from.count_];
  add(path.from, {path.anchor, weight});
}

void Blend::carry_dead(Path& path) {
  for (std::size_t i = path.from.count_; i-- > 0;) {
    if (is_dead_[path.from.shares_[i].node]) carry(path, i);
  }
}

// Gives false where there are too many for a step of one hierarchy.
bool Blend::find_changes(std::span<const Index> labels) {
  changes_.clear();
  for_each_difference(targets_, labels.first(targets_.size()), [&](Index v) {
    changes_.push_back({labels_[v], labels[v], v});
  });
  if (changes_.size() > targets_.size() / 2) return false;
  std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
    return std::tie(a.source, a.target, a.vertex) < std::tie(b.source, b.target, b.vertex);
  });
  return true;
}

// The triangles around the group, as they are drawn.
void Blend::list_images(std::span<const Change> group, std::vector<Triangle>& images) const {
  images.clear();
  for (const Change& change : group) {
    for (Index i = link_begin_[change.vertex]; i < link_begin_[change.vertex + 1]; ++i) {
      Triangle image{labels_[change.vertex], labels_[links_[i][0]], labels_[links_[i][1]]};
      if (is_degenerate(image)) continue;
      std::rotate(image.begin(), std::min_element(image.begin(), image.end()), image.end());
      images.push_back(image);
    }
  }
  std::sort(images.begin(), images.end());
  images.erase(std::unique(images.begin(), images.end()), images.end());
}

// The share of its way that is left.
float Blend::left(const Path& path) const {
  return 1 - static_cast<float>(path.steps) / static_cast<float>(options_.frames);
}

Blend::Shares Blend::shares(Index i) const {
  const Path& path = paths_[i];
  Shares shares;
  if (path.vertex_count == 0) return shares;
  for (const auto& [node, weight] : path.from) add(shares, {node, left(path) * weight});
  add(shares, {path.target, 1 - left(path)});
  return shares;
}

Blend::Path Blend::path_of(std::span<const Change> group) const {
  const Index source = group.front().source;
  Path path;
  path.target = group.front().target;
  path.vertex_count = static_cast<Index>(group.size());
  if (source >= node_count_) {
    const Path& before = paths_[source - node_count_];
    path.from = shares(source - node_count_);
    path.offset = left(before) * before.offset;
    path.anchor = before.anchor;
    return path;
  }
  path.anchor = group.front().vertex;
  add(path.from, {source, 1});
  const auto distance = [&, place = positions_[source]](Index v) { return squared_length(positions_[v] - place); };
  for (const Change& change : group) {
    if (distance(change.vertex) < distance(path.anchor)) path.anchor = change.vertex;
  }
  return path;
}

void Blend::leave(Index label) {
  if (label < node_count_) return;
  Path& path = paths_[label - node_count_];
  if (--path.vertex_count == 0) free_.push_back(label - node_count_);
}

// A step adds the target to the shares.
void Blend::make_room(Path& path) {
  while (path.from.count_ >= Shares::kMost) {
    std::size_t least = path.from.shares_[0].node == path.anchor;
    for (std::size_t i = least; i < path.from.count_; ++i) {
      const Share& share = path.from.shares_[i];
      if (share.node != path.anchor && share.weight < path.from.shares_[least].weight) least = i;
    }
    carry(path, least);
  }
}

void Blend::start(std::span<const Change> group) {
  list_images(group, images_before_);
  for (const Change& change : group) labels_[change.vertex] = change.target;
  list_images(group, images_now_);
  if (images_now_ == images_before_) return;

  Path path = path_of(group);
  carry_dead(path);
  make_room(path);
  if (free_.empty()) {
    free_.push_back(static_cast<Index>(paths_.size()));
    paths_.emplace_back();
  }
  const Index number = free_.back();
  free_.pop_back();
  paths_[number] = path;
  for (const Change& change : group) labels_[change.vertex] = node_count_ + number;
}

void Blend::go_on() {
  bool arrive = false;
  for (Path& path : paths_) {
    if (path.vertex_count == 0) continue;
    arrive |= ++path.steps == options_.frames;
  }
  if (!arrive) return;
  for (std::size_t v = 0; v < labels_.size(); ++v) {
    if (labels_[v] < node_count_ || paths_[labels_[v] - node_count_].steps < options_.frames) continue;
    leave(labels_[v]);
    labels_[v] = targets_[v];
  }
}

void Blend::place(const FrameState& state) {
  positions_.assign(state.positions.begin(), state.positions.end());
  positions_.resize(node_count_ + paths_.size());
  for (Index i = 0; i < paths_.size(); ++i) {
    if (paths_[i].vertex_count == 0) continue;
    Vec3f& position = positions_[node_count_ + i];
    position = left(paths_[i]) * paths_[i].offset;
    for (const auto& [node, weight] : shares(i)) position += weight * positions_[node];
  }
}

void Blend::update(const FrameState& state, const Cut& cut) {
  assert(state.positions.size() == node_count_ && cut.labels().size() == node_count_);
  const bool is_comparable = options_.frames > 1 && frame_ != kNone && is_same(cut.options(), cut_options_);
  const bool is_step = is_comparable && state.frame == frame_ + 1;
  const bool is_shown =
      is_comparable && state.frame == frame_ && std::equal(targets_.begin(), targets_.end(), cut.labels().begin());
  if (is_shown) return place(state);
  frame_ = state.frame;
  cut_options_ = cut.options();
  if (!is_step || !find_changes(cut.labels())) return show(state, cut);

  find_deaths(state.hierarchy);
  if (!dead_.empty()) {
    for (Path& path : paths_) carry_dead(path);
  }
  for (auto first = changes_.begin(); first != changes_.end();) {
    const auto last = std::find_if(first, changes_.end(), [&](const Change& change) {
      return change.source != first->source || change.target != first->target;
    });
    start({first, last});
    first = last;
  }
  for (const Change& change : changes_) {
    targets_[change.vertex] = change.target;
    leave(change.source);
  }
  go_on();
  place(state);
}

}  // namespace limber
