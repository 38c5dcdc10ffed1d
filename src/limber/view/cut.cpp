// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, section 5.1: "some arbitrary cut through the tree that should be maintained". The paper
// updates the active triangles from stored changes of degenerate sets; here each frame's cut is made anew in flat
// passes over all nodes, which is faster (docs/design.md) and needs nothing from the frame before but one bit per node.
//
//   count_children                        what of each node's children stands for any surface
//   expand_...                            which nodes are expanded, by the criterion
//   label_nodes                           from the top down: label(n) = label(parent), or n where that is expanded
#include "limber/view/cut.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "limber/base/vec.h"

namespace limber {

namespace {

// Adds to the area of each node that of its surface; a third of each triangle goes to each corner.
void measure_areas(const Mesh& mesh, const FrameState& state, std::span<double> area) {
  std::fill(area.begin(), area.end(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a(state.positions[t[0]]), b(state.positions[t[1]]), c(state.positions[t[2]]);
    const double third = length(cross(b - a, c - a)) / 6;
    for (const Index corner : t) area[corner] += third;
  }
  const Index top_begin = state.hierarchy.level_begin[state.hierarchy.level_count() - 1];
  for (Index n = 0; n < top_begin; ++n) area[state.hierarchy.parent[n]] += area[n];
}

double diagonal(std::span<const Vec3f> positions) {
  Box box;
  for (const Vec3f& p : positions) box.add(Vec3d(p));
  return box.diagonal();
}

// The label of a node whose parent has the label `above`; `own` is that of a node whose parent is expanded. Nodes have
// lower numbers than their ancestors, and kNone, as a signed number, is lower than any: so it is the larger of the two.
// Compilers make a branch of a choice here, and nothing can foresee that branch.
Index label_below(Index above, Index own) {
  return static_cast<Index>(std::max(static_cast<std::int32_t>(above), static_cast<std::int32_t>(own)));
}

}  // namespace

Cut::Cut(const Mesh& mesh, const Hierarchy& hierarchy, const CutOptions& options) {
  assert(mesh.vertex_count == hierarchy.vertex_count() && hierarchy.node_count() <= kNone / 2);
  triangle_count_ = mesh.triangles.size();
  labels_.assign(hierarchy.node_count(), kNone);
  set_options(options);
  const std::size_t coarse_count = hierarchy.node_count() - hierarchy.vertex_count();
  budget_.reserve(hierarchy);
  find_parts(mesh);
  expanded_.assign(coarse_count, 0);
  surface_children_.assign(coarse_count, 0);
  counted_parents_.assign(hierarchy.vertex_count(), kNone);
  vertices_below_.resize(coarse_count);
  part_size_below_.resize(coarse_count);
  is_drawn_.assign(coarse_count, 0);
  price_.resize(coarse_count);
}

// Union and find over the triangles, which alone draw: their corners are connected.
void Cut::find_parts(const Mesh& mesh) {
  std::vector<Index> root(mesh.vertex_count);
  std::iota(root.begin(), root.end(), Index{0});
  const auto find = [&](Index v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  has_surface_.assign(mesh.vertex_count, 0);
  for (const Triangle& t : mesh.triangles) {
    if (is_degenerate(t)) continue;
    for (const Index corner : t) {
      has_surface_[corner] = 1;
      root[find(corner)] = find(t[0]);
    }
  }
  std::vector<Index> size(mesh.vertex_count, 0);
  for (Index v = 0; v < mesh.vertex_count; ++v) size[find(v)] += has_surface_[v];
  largest_part_ = size.empty() ? 0 : *std::max_element(size.begin(), size.end());
  part_size_.resize(mesh.vertex_count);
  for (Index v = 0; v < mesh.vertex_count; ++v) part_size_[v] = size[find(v)];
  has_parts_ = largest_part_ != std::accumulate(size.begin(), size.end(), Index{0});
}

void Cut::set_options(const CutOptions& options) {
  assert(options.hysteresis >= 1 && options.error_bound >= 0);
  options_ = options;
  if (options.by == CutBy::kTriangles) images_.resize(triangle_count_);
  if (options.by == CutBy::kError) area_.resize(labels_.size());
}

// The finest vertices, by far the most, are counted over only where their parents are no longer those counted last; few
// are from one frame to the next.
void Cut::count_finest_children(const Hierarchy& hierarchy) {
  constexpr Index kBlock = 16;
  const Index base = hierarchy.vertex_count();
  const Index* parents = hierarchy.parent.data();
  Index* counted = counted_parents_.data();
  for (Index begin = 0; begin < base; begin += kBlock) {
    const Index end = std::min(begin + kBlock, base);
    if (std::equal(parents + begin, parents + end, counted + begin)) continue;
    for (Index v = begin; v < end; ++v) {
      if (counted[v] != kNone) surface_children_[counted[v] - base] -= has_surface_[v];
      surface_children_[parents[v] - base] += has_surface_[v];
      counted[v] = parents[v];
    }
  }
}

void Cut::count_children(const Hierarchy& hierarchy) {
  const Index base = hierarchy.vertex_count();
  const Index top_begin = hierarchy.level_begin[hierarchy.level_count() - 1];
  if (top_begin == 0) return;
  const Index* parents = hierarchy.parent.data();
  std::uint32_t* children = surface_children_.data();
  count_finest_children(hierarchy);
  std::fill(surface_children_.begin() + hierarchy.level_size(1), surface_children_.end(), 0);
  for (Index n = base; n < top_begin; ++n) children[parents[n] - base] += children[n - base] != 0;
  find_drawn(hierarchy);
}

// A node can be drawn iff it has some, but not as many finest vertices with surface as the part of the mesh it lies in.
// Where all of the mesh is one part, a node has all of it iff no other of its level has any.
void Cut::find_drawn(const Hierarchy& hierarchy) {
  if (has_parts_) return find_drawn_among_parts(hierarchy);
  const Index base = hierarchy.vertex_count();
  const std::uint32_t* children = surface_children_.data();
  std::uint8_t* is_drawn = is_drawn_.data();
  for (Index level = 1; level < hierarchy.level_count(); ++level) {
    const Index begin = hierarchy.level_begin[level] - base, end = hierarchy.level_begin[level + 1] - base;
    Index count = 0;
    for (Index n = begin; n < end; ++n) {
      const bool has_surface = children[n] != 0;
      is_drawn[n] = has_surface;
      count += Index{has_surface};
    }
    if (count == 1) std::fill(is_drawn + begin, is_drawn + end, std::uint8_t{0});
  }
}

void Cut::find_drawn_among_parts(const Hierarchy& hierarchy) {
  const Index base = hierarchy.vertex_count();
  const Index top_begin = hierarchy.level_begin[hierarchy.level_count() - 1];
  const Index* parents = hierarchy.parent.data();
  std::uint32_t* vertices = vertices_below_.data();
  Index* part_size = part_size_below_.data();
  const auto level_1_end = hierarchy.level_begin[2];
  std::copy_n(surface_children_.begin(), level_1_end - base, vertices_below_.begin());
  std::fill(vertices_below_.begin() + (level_1_end - base), vertices_below_.end(), 0);
  std::fill(part_size_below_.begin(), part_size_below_.end(), largest_part_);
  for (Index v = 0; v < base; ++v) {
    if (has_surface_[v]) part_size[parents[v] - base] = part_size_[v];
  }
  for (Index n = base; n < top_begin; ++n) {
    const Index parent = parents[n] - base;
    vertices[parent] += vertices[n - base];
    if (vertices[n - base] != 0) part_size[parent] = part_size[n - base];
  }
  std::uint8_t* is_drawn = is_drawn_.data();
  const std::uint32_t* children = surface_children_.data();
  for (std::size_t n = 0; n < is_drawn_.size(); ++n) is_drawn[n] = (children[n] != 0) & (vertices[n] != part_size[n]);
}

// Gives what of the budget the top level leaves, as the next.
std::uint32_t Cut::price_vertices(const Hierarchy& hierarchy) {
  const Index base = hierarchy.vertex_count();
  const Index top_begin = hierarchy.level_begin[hierarchy.level_count() - 1];
  for (std::size_t n = 0; n < price_.size(); ++n) {
    const std::uint32_t children = surface_children_[n];
    price_[n] = (children - is_drawn_[n]) & (0 - std::uint32_t{children > 1});
  }
  Index top_count = 0;
  for (std::size_t n = top_begin - base; n < price_.size(); ++n) top_count += is_drawn_[n];
  return options_.budget > top_count ? options_.budget - top_count : 0;
}

// A finest triangle is in the degenerate set of the finest node at which two of its corners meet, and is drawn iff that
// node is expanded: the price of a node is the size of its set. Level by level, without branches: triangles are mapped
// to the level, counted where two corners met, and kept where not.
std::uint32_t Cut::price_triangles(const Mesh& mesh, const Hierarchy& hierarchy) {
  const Index* parents = hierarchy.parent.data();
  Triangle* images = images_.data();
  std::size_t living = 0;
  for (const Triangle& t : mesh.triangles) {
    images[living] = t;
    living += !is_degenerate(t);
  }
  std::fill(price_.begin(), price_.end(), 0);
  for (Index level = 1; level < hierarchy.level_count(); ++level) {
    std::uint32_t* price = price_.data();
    const Index base = hierarchy.vertex_count();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < living; ++i) {
      const Index a = parents[images[i][0]], b = parents[images[i][1]], c = parents[images[i][2]];
      const bool met = (a == b) | (b == c) | (c == a);
      price[(b == c ? b : a) - base] += met;
      images[kept] = {a, b, c};
      kept += !met;
    }
    living = kept;
  }
  return options_.budget > living ? options_.budget - static_cast<std::uint32_t>(living) : 0;
}

void Cut::expand_down_to_level(const Hierarchy& hierarchy) {
  const Index level = std::min(options_.level, hierarchy.level_count() - 1);
  const Index first = hierarchy.level_begin[level + 1] - hierarchy.vertex_count();
  for (Index n = 0; n < expanded_.size(); ++n) expanded_[n] = n >= first;
}

void Cut::expand_by_error(const Mesh& mesh, const FrameState& state) {
  const Index base = state.hierarchy.vertex_count();
  measure_areas(mesh, state, area_);
  const double bound =
      double{options_.error_bound} / 100 * diagonal(std::span(state.positions).first(mesh.vertex_count));
  const double bounds[2] = {bound, bound / std::sqrt(double{options_.hysteresis})};
  for (std::size_t n = 0; n < expanded_.size(); ++n) {
    expanded_[n] = double{state.errors[base + n]} > bounds[expanded_[n]] * std::sqrt(area_[base + n]);
  }
}

// A node whose ancestors are not all expanded is not expanded either, whatever the criterion said of it.
void Cut::label_nodes(const Hierarchy& hierarchy) {
  const Index base = hierarchy.vertex_count();
  const Index top_begin = hierarchy.level_begin[hierarchy.level_count() - 1];
  const Index node_count = hierarchy.node_count();
  const Index* parents = hierarchy.parent.data();
  Index* labels = labels_.data();
  std::uint8_t* expanded = expanded_.data();
  const auto own_label = [&](Index n) { return n | (Index{0} - expanded[n - base]); };
  for (Index n = node_count; n-- > std::max(top_begin, base);) labels[n] = own_label(n);
  for (Index n = top_begin; n-- > base;) labels[n] = label_below(labels[parents[n]], own_label(n));
  if (top_begin == 0) {
    for (Index v = 0; v < base; ++v) labels[v] = v;
  } else {
    for (Index v = 0; v < base; ++v) labels[v] = label_below(labels[parents[v]], v);
  }
  for (Index n = base; n < node_count; ++n) expanded[n - base] = labels[n] == kNone;
}

void Cut::count_vertices(const Hierarchy& hierarchy) {
  const Index base = hierarchy.vertex_count();
  const Index* labels = labels_.data();
  const std::uint8_t* is_drawn = is_drawn_.data();
  Index count = 0;
  for (Index n = base; n < hierarchy.node_count(); ++n) count += Index{labels[n] == n} & is_drawn[n - base];
  if (hierarchy.level_count() == 1) {
    for (const std::uint8_t has : has_surface_) count += has;
  } else {
    for (Index n = 0; n < hierarchy.level_size(1); ++n) count += expanded_[n] * surface_children_[n];
  }
  vertex_count_ = count;
}

void Cut::update(const Mesh& mesh, const FrameState& state) {
  assert(labels_.size() == state.hierarchy.node_count() && state.errors.size() == labels_.size());
  assert(mesh.vertex_count == has_surface_.size());
  const std::span<const float> errors = std::span(state.errors).subspan(mesh.vertex_count);
  count_children(state.hierarchy);
  switch (options_.by) {
    case CutBy::kLevel:
      expand_down_to_level(state.hierarchy);
      break;
    case CutBy::kVertices: {
      const std::uint32_t left = price_vertices(state.hierarchy);
      budget_.choose(state.hierarchy, {errors, price_, left}, options_.hysteresis, expanded_);
      break;
    }
    case CutBy::kTriangles: {
      const std::uint32_t left = price_triangles(mesh, state.hierarchy);
      budget_.choose(state.hierarchy, {errors, price_, left}, options_.hysteresis, expanded_);
      break;
    }
    case CutBy::kError:
      expand_by_error(mesh, state);
      break;
  }
  label_nodes(state.hierarchy);
  count_vertices(state.hierarchy);
}

}  // namespace limber
