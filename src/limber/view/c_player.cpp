// SPDX-License-Identifier: Apache-2.0
// limber/player.h over Player, Cut and extract().
//
//   bytes arrive -> ArrivingBytes -> open: header and mesh are there        -> Player::open
//                                    the end is there, the size known       -> Player::use_index
//                                    else more of the prefix                -> Player::extend
#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "limber/player.h"
#include "limber/stream/chunk.h"
#include "limber/view/arriving_bytes.h"
#include "limber/view/blend.h"
#include "limber/view/cut.h"
#include "limber/view/extract.h"
#include "limber/view/moved_vertices.h"
#include "limber/view/player.h"
#include "limber/view/vertex_errors.h"
#include "limber/view/view.h"

using namespace limber;

static_assert(LIMBER_NONE == kNone && LIMBER_MOST_LEVELS == kMostLevels);
static_assert(LIMBER_BY_LEVEL == static_cast<int>(CutBy::kLevel));
static_assert(LIMBER_BY_VERTICES == static_cast<int>(CutBy::kVertices));
static_assert(LIMBER_BY_TRIANGLES == static_cast<int>(CutBy::kTriangles));
static_assert(LIMBER_BY_ERROR == static_cast<int>(CutBy::kError));
static_assert(sizeof(Vec3f) == 3 * sizeof(float));

struct limber_player {
  ArrivingBytes bytes;
  Player player;
  bool is_open = false;
  bool has_index = false;
  bool lacks_index = false;                                     // its end is there, and none stands there
  std::optional<std::uint64_t> index_at;                        // where the end says that the index begins
  std::optional<std::pair<limber_status, std::string>> broken;  // the error that ended the bytes
  bool has_stepped = false;
  std::vector<Index> old_parents;  // [node_count]: before the swaps of the frame shown
  mutable std::string error;

  limber_status fail(limber_status status, std::string what) const {
    error = std::move(what);
    return status;
  }
  limber_status fail(const Error& what) const {
    const bool unsupported = what.code == ErrorCode::kUnsupported;
    const bool truncated = what.code == ErrorCode::kTruncated;
    return fail(unsupported ? LIMBER_UNSUPPORTED : (truncated ? LIMBER_NEEDS_MORE : LIMBER_BAD_STREAM), what.line());
  }
  limber_status break_off(const Error& what) {
    const limber_status status = fail(what);
    if (status != LIMBER_NEEDS_MORE) broken = {status, error};
    return status;
  }

  std::optional<limber_status> refusal() const;
  std::uint64_t opening_end() const;
  Extent end_wanted() const;
  limber_status advance();
  bool find_index();
};

struct limber_cut {
  explicit limber_cut(limber_player& owner) : of(owner) {}

  limber_player& of;
  std::optional<Cut> cut;
  std::optional<Blend> blend;  // where changes are blended
  ExtractScratch scratch;
  MeshBuffers buffers;
  VertexErrors errors;
  std::vector<Index> targets;               // of a blend: the buffers' nodes, but where moving vertices go
  std::span<const Index> nodes;             // [buffers.vertex_count()]: those, or the buffers'
  std::vector<std::uint8_t> levels, moved;  // [buffers.vertex_count()]
};

namespace {

std::span<const std::byte> as_span(const void* bytes, std::size_t size) {
  return {static_cast<const std::byte*>(bytes), size};
}

// The members that the caller's structure has, its size first.
template <class T>
bool give(const T& value, T* to) {
  if (!to || to->struct_size < sizeof(to->struct_size)) return false;
  const std::uint32_t size = std::min<std::uint32_t>(to->struct_size, sizeof(T));
  const std::uint32_t callers = to->struct_size;
  std::memcpy(static_cast<void*>(to), &value, size);
  to->struct_size = callers;
  return true;
}

// The members that the caller's structure has; the others stay as they are.
template <class T>
bool take(const T* from, T& to) {
  if (!from || from->struct_size < sizeof(from->struct_size)) return false;
  std::memcpy(static_cast<void*>(&to), from, std::min<std::size_t>(from->struct_size, sizeof(T)));
  return true;
}

std::optional<limber_cut_options> take_options(const limber_cut_options* from) {
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  const bool is_valid = take(from, options) && options.by <= LIMBER_BY_ERROR && options.error_bound >= 0 &&
                        options.hysteresis >= 1 && options.hold <= 1 && options.enough >= 0;
  return is_valid ? std::optional(options) : std::nullopt;
}

// In single precision squares of what is below this are finite.
constexpr double kFarthest = 1e18;

bool is_near(double x) { return std::abs(x) < kFarthest; }

std::optional<Vec3d> take_place(const double (&from)[3]) {
  const bool is_valid = is_near(from[0]) && is_near(from[1]) && is_near(from[2]);
  return is_valid ? std::optional(Vec3d{from[0], from[1], from[2]}) : std::nullopt;
}

bool is_factor(float x) { return x >= 1 && is_near(x); }

std::optional<Camera> take_camera(const limber_view& view) {
  const auto eye = take_place(view.eye), target = take_place(view.target), up = take_place(view.up);
  if (!eye || !target || !up || !(view.fov_degrees > 0 && view.fov_degrees <= 120)) return std::nullopt;
  if (view.width == 0 || view.height == 0 || !is_factor(view.silhouettes) || !is_factor(view.facing_away))
    return std::nullopt;
  return Camera{.eye = *eye, .target = *target, .up = *up, .fov_degrees = view.fov_degrees};
}

std::optional<Focus> take_focus(const limber_view& view) {
  const auto center = take_place(view.focus_center);
  if (!center || !(view.focus_radius > 0) || !is_near(view.focus_radius) || !is_factor(view.focus_outside))
    return std::nullopt;
  return Focus{.center = *center, .radius = view.focus_radius, .outside = view.focus_outside};
}

std::optional<Along> take_along(const limber_view& view) {
  if (view.along_axis > 2 || !is_near(view.along_from) || !is_near(view.along_to) || !is_factor(view.along_coarsest))
    return std::nullopt;
  return Along{.axis = static_cast<int>(view.along_axis),
               .from = view.along_from,
               .to = view.along_to,
               .coarsest = view.along_coarsest};
}

std::optional<View> take_view(const limber_view* from) {
  limber_view given = LIMBER_VIEW_DEFAULTS;
  if (!take(from, given)) return std::nullopt;
  const auto looks_at = [&](std::uint32_t criterion) { return (given.criteria & criterion) != 0; };
  View view;
  if (looks_at(LIMBER_VIEW_CAMERA)) {
    if (!(view.camera = take_camera(given))) return std::nullopt;
    view.width = given.width, view.height = given.height;
    view.silhouettes = given.silhouettes, view.facing_away = given.facing_away;
  }
  if (looks_at(LIMBER_VIEW_FOCUS) && !(view.focus = take_focus(given))) return std::nullopt;
  if (looks_at(LIMBER_VIEW_ALONG) && !(view.along = take_along(given))) return std::nullopt;
  constexpr std::uint32_t kKnown = LIMBER_VIEW_CAMERA | LIMBER_VIEW_FOCUS | LIMBER_VIEW_ALONG;
  return (given.criteria & ~kKnown) == 0 ? std::optional(view) : std::nullopt;
}

bool is_same(const CutOptions& a, const CutOptions& b) {
  return a.by == b.by && a.level == b.level && a.budget == b.budget && a.error_bound == b.error_bound &&
         a.hysteresis == b.hysteresis && a.hold == b.hold && a.enough == b.enough;
}

void list_levels(const Hierarchy& hierarchy, std::span<const Index> nodes, std::vector<std::uint8_t>& levels) {
  levels.resize(nodes.size());
  for (std::size_t v = 0; v < nodes.size(); ++v) levels[v] = static_cast<std::uint8_t>(hierarchy.level_of(nodes[v]));
}

// The mesh of the cut, or of the blend that leads to it.
void extract_shown(limber_cut& cut, Index blend_frames) {
  const Mesh& finest = cut.of.player.mesh();
  const FrameState& state = cut.of.player.state();
  if (blend_frames <= 1) {
    cut.blend.reset();
    extract(finest, state, *cut.cut, cut.scratch, cut.buffers);
    cut.nodes = cut.buffers.nodes;
    return;
  }
  if (!cut.blend || cut.blend->options().frames != blend_frames)
    cut.blend.emplace(finest, state.hierarchy, BlendOptions{.frames = blend_frames});
  cut.blend->update(state, *cut.cut);
  extract(finest, *cut.blend, cut.scratch, cut.buffers);
  const Index node_count = cut.blend->node_count();
  cut.targets = cut.buffers.nodes;
  for (Index& node : cut.targets)
    if (node >= node_count) node = cut.blend->target(node - node_count);
  cut.nodes = cut.targets;
}

}  // namespace

std::optional<limber_status> limber_player::refusal() const {
  if (!broken) return std::nullopt;
  return fail(broken->first, broken->second);
}

// Where header and mesh end, as far as the prefix tells; else where the next is that tells more.
std::uint64_t limber_player::opening_end() const {
  const std::span<const std::byte> prefix = bytes.bytes().first(static_cast<std::size_t>(bytes.prefix()));
  std::uint64_t offset = kPreambleSize;
  while (true) {
    if (prefix.size() < offset + kChunkHeaderSize) return offset + kChunkHeaderSize;
    const auto chunk = read_chunk_header(prefix, offset);
    if (!chunk) return offset;  // open() says what is wrong
    offset += kChunkHeaderSize + chunk->length;
    if (chunk->kind == kMeshChunk || prefix.size() < offset) return offset;
  }
}

// What is to be there at the end for the index: the mark that says where it begins, then all of it. Where the number of
// frames is known, as much at once as the index can be. Precondition: the size is known.
Extent limber_player::end_wanted() const {
  const std::uint64_t size = *bytes.size();
  if (index_at) return {*index_at, size};
  std::uint64_t length = kEndMarkSize;
  if (const auto frames = player.frame_count()) length += kChunkHeaderSize + 8 + 12 * std::uint64_t{*frames};
  return {size - std::min(size, length), size};
}

// Whether use_index() may be called now.
bool limber_player::find_index() {
  const std::uint64_t size = *bytes.size();
  const Extent mark{size - std::min<std::uint64_t>(size, kEndMarkSize), size};
  if (mark.end - mark.begin < kEndMarkSize) lacks_index = true;
  if (lacks_index || !bytes.has(mark)) return false;
  if (!index_at) {
    const std::byte* end_mark = bytes.bytes().data() + mark.begin;
    const auto offset = load_little_endian<std::uint64_t>(end_mark);
    lacks_index = std::memcmp(end_mark + 8, kEndMagic.data(), kEndMagic.size()) != 0 || offset > mark.begin;
    if (lacks_index) return false;
    index_at = offset;
  }
  return bytes.has({*index_at, size});
}

// What the bytes that have come make possible.
limber_status limber_player::advance() {
  const auto prefix = [&] { return bytes.bytes().first(static_cast<std::size_t>(bytes.prefix())); };
  if (!is_open) {
    if (bytes.prefix() < opening_end()) {
      // What is wrong with the first bytes is said at once.
      constexpr std::size_t kCheap = 4096;
      const Result<void> opened = player.open(prefix().first(std::min(prefix().size(), kCheap)));
      if (!opened && opened.error().code != ErrorCode::kTruncated) return break_off(opened.error());
      return fail(LIMBER_NEEDS_MORE, place_in_stream(bytes.prefix()) + ": the stream ends before its first frame");
    }
    const Result<void> opened = player.open(prefix());
    if (!opened) return break_off(opened.error());
    is_open = true;
    old_parents.assign(player.header().level_begin.back(), kNone);
  } else if (!has_index) {
    const Result<void> extended = player.extend(prefix());
    if (!extended) return break_off(extended.error());
  }
  if (!has_index && bytes.size() && find_index()) {
    const Result<bool> used = player.use_index(bytes.bytes());
    if (!used) return break_off(used.error());
    has_index = *used;
    lacks_index = !*used;
  }
  if (player.state().frame == kNone && !has_stepped && player.available_frames() > 0 && bytes.has(player.extent(0))) {
    if (const Result<void> shown = player.seek(0); !shown) return break_off(shown.error());
  }
  error.clear();
  return LIMBER_OK;
}

limber_player* limber_player_create(void) { return new (std::nothrow) limber_player; }

void limber_player_destroy(limber_player* player) { delete player; }

const char* limber_error(const limber_player* player) { return player->error.c_str(); }

limber_status limber_append(limber_player* player, const void* bytes, size_t size) {
  if (const auto refused = player->refusal()) return *refused;
  const auto whole = player->bytes.size();
  if (size > 0 && !bytes) return player->fail(LIMBER_WRONG_CALL, "limber_append: no bytes");
  if (whole && size > *whole - player->bytes.prefix())
    return player->fail(LIMBER_WRONG_CALL, "limber_append: more bytes than limber_set_size() said");
  if (!player->bytes.append(as_span(bytes, size)))
    return player->fail(LIMBER_NO_MEMORY, "no memory for the bytes of the stream");
  return player->advance();
}

limber_status limber_set_size(limber_player* player, uint64_t size) {
  if (const auto refused = player->refusal()) return *refused;
  if (player->bytes.size() || size < player->bytes.prefix())
    return player->fail(LIMBER_WRONG_CALL, "limber_set_size: called twice, or with less than is there");
  if (!player->bytes.set_size(size)) return player->fail(LIMBER_NO_MEMORY, "no memory for the bytes of the stream");
  return player->advance();
}

limber_status limber_supply(limber_player* player, uint64_t offset, const void* bytes, size_t size) {
  if (const auto refused = player->refusal()) return *refused;
  const auto whole = player->bytes.size();
  if (!whole || offset > *whole || size > *whole - offset || (size > 0 && !bytes))
    return player->fail(LIMBER_WRONG_CALL, "limber_supply: outside the size that limber_set_size() said");
  player->bytes.supply(offset, as_span(bytes, size));
  return player->advance();
}

limber_status limber_missing(const limber_player* player, uint32_t frame, limber_range* range) {
  const ArrivingBytes& bytes = player->bytes;
  const std::uint64_t prefix = bytes.prefix();
  if (const auto refused = player->is_open ? std::nullopt : player->refusal()) return *refused;
  const auto give_gap = [&](const Extent& wanted) {
    const Extent gap = bytes.first_missing(wanted);
    if (gap.begin == gap.end) return LIMBER_OK;
    *range = {gap.begin, gap.end - gap.begin};
    return player->fail(LIMBER_NEEDS_MORE, place_in_stream(gap.begin) + " is not there yet");
  };
  *range = {prefix, 0};
  if (!player->is_open) {
    const std::uint64_t end = std::max(player->opening_end(), prefix + 1);
    if (bytes.size() && end > *bytes.size())
      return player->fail(LIMBER_BAD_STREAM,
                          place_in_stream(*bytes.size()) + ": the stream ends before its first frame");
    return give_gap({prefix, end});
  }
  const Player& of = player->player;
  const bool is_available = frame < of.available_frames();
  if (!player->has_index && !player->lacks_index && bytes.size() && !player->broken && !is_available)
    if (const limber_status status = give_gap(player->end_wanted()); status != LIMBER_OK) return status;
  if (frame == LIMBER_NONE) return LIMBER_OK;
  if (is_available) {
    const std::uint32_t first = of.first_decoded(frame);
    return first > frame ? LIMBER_OK : give_gap({of.extent(first).begin, of.extent(frame).end});
  }
  if (frame >= of.frame_count().value_or(LIMBER_NONE))
    return player->fail(LIMBER_WRONG_CALL, "the stream has no frame " + std::to_string(frame));
  if (const auto refused = player->refusal()) return *refused;
  if (bytes.size() && prefix == *bytes.size())
    return player->fail(LIMBER_BAD_STREAM,
                        place_in_stream(prefix) + ": the stream ends before frame " + std::to_string(frame));
  if (bytes.size()) return give_gap({prefix, *bytes.size()});
  return player->fail(LIMBER_NEEDS_MORE, place_in_stream(prefix) + " is not there yet");
}

limber_status limber_get_info(const limber_player* player, limber_info* info) {
  if (!player->is_open) return player->fail(LIMBER_NEEDS_MORE, "header and mesh are not there yet");
  const Player& of = player->player;
  const StreamHeader& header = of.header();
  limber_info value = LIMBER_INFO_INIT;
  value.frame_count = of.frame_count().value_or(LIMBER_NONE);
  value.available_frames = of.available_frames();
  value.first_frame_number = header.first_frame_number;
  value.frames_per_second = header.frames_per_second;
  value.tolerance = header.tolerance;
  value.diagonal = header.diagonal;
  value.size = player->bytes.size().value_or(0);
  value.bytes_there = player->bytes.count();
  value.has_index = player->has_index;
  value.key_interval = header.key_interval;
  value.vertex_count = of.mesh().vertex_count;
  value.triangle_count = static_cast<std::uint32_t>(of.mesh().triangles.size());
  value.node_count = header.level_begin.back();
  value.level_count = static_cast<std::uint32_t>(header.level_begin.size() - 1);
  for (std::uint32_t level = 0; level < value.level_count; ++level)
    value.level_size[level] = header.level_begin[level + 1] - header.level_begin[level];
  if (!give(value, info)) return player->fail(LIMBER_WRONG_CALL, "limber_get_info: struct_size is not set");
  return LIMBER_OK;
}

limber_status limber_get_frame(const limber_player* player, uint32_t frame, limber_frame* info) {
  if (!player->is_open || frame >= player->player.available_frames())
    return player->fail(LIMBER_NEEDS_MORE, "frame " + std::to_string(frame) + " is not available yet");
  const Extent extent = player->player.extent(frame);
  limber_frame value = LIMBER_FRAME_INIT;
  value.key = player->player.key_at_or_before(frame);
  value.is_there = player->bytes.has(extent);
  value.offset = extent.begin;
  value.size = extent.end - extent.begin;
  if (!give(value, info)) return player->fail(LIMBER_WRONG_CALL, "limber_get_frame: struct_size is not set");
  return LIMBER_OK;
}

uint32_t limber_shown_frame(const limber_player* player) {
  return player->is_open ? player->player.state().frame : LIMBER_NONE;
}

limber_status limber_seek(limber_player* player, uint32_t frame) {
  if (frame == LIMBER_NONE) return player->fail(LIMBER_WRONG_CALL, "limber_seek: no frame");
  limber_range range;
  if (const limber_status status = limber_missing(player, frame, &range); status != LIMBER_OK) return status;
  player->has_stepped = true;
  Player& of = player->player;
  const std::uint32_t first = of.first_decoded(frame);
  Result<void> there;
  if (first < frame) there = of.seek(frame - 1);
  if (there && first <= frame && of.key_at_or_before(frame) != frame)
    std::copy_n(of.state().hierarchy.parent.begin(), player->old_parents.size(), player->old_parents.begin());
  if (there) there = of.seek(frame);
  if (!there) return player->fail(there.error());
  return LIMBER_OK;
}

limber_status limber_step(limber_player* player) {
  if (!player->is_open) return player->fail(LIMBER_NEEDS_MORE, "header and mesh are not there yet");
  const std::uint32_t next = player->has_stepped ? player->player.next_frame() : 0;
  if (next >= player->player.frame_count().value_or(LIMBER_NONE))
    return player->fail(LIMBER_NEEDS_MORE, "there are no more frames");
  return limber_seek(player, next);
}

limber_cut* limber_cut_create(limber_player* player) { return new (std::nothrow) limber_cut(*player); }

void limber_cut_destroy(limber_cut* cut) { delete cut; }

limber_status limber_cut_update(limber_cut* cut, const limber_cut_options* options, limber_mesh* mesh) {
  const limber_player& player = cut->of;
  if (limber_shown_frame(&player) == LIMBER_NONE) return player.fail(LIMBER_NEEDS_MORE, "no frame is shown");
  const auto chosen = take_options(options);
  if (!chosen) return player.fail(LIMBER_WRONG_CALL, "limber_cut_update: options outside their ranges");
  const std::optional<View> view = chosen->view ? take_view(chosen->view) : std::nullopt;
  if (chosen->view && !view) return player.fail(LIMBER_WRONG_CALL, "limber_cut_update: a view outside its ranges");
  const CutOptions cut_options{.by = static_cast<CutBy>(chosen->by),
                               .level = chosen->level,
                               .budget = chosen->budget,
                               .error_bound = chosen->error_bound,
                               .hysteresis = chosen->hysteresis,
                               .hold = chosen->hold != 0,
                               .enough = chosen->enough};
  const Mesh& finest = player.player.mesh();
  const FrameState& state = player.player.state();
  if (!cut->cut) cut->cut.emplace(finest, state.hierarchy, cut_options);
  if (!is_same(cut->cut->options(), cut_options)) cut->cut->set_options(cut_options);
  if (view)
    cut->cut->update(finest, state, *view);
  else
    cut->cut->update(finest, state);
  extract_shown(*cut, chosen->blend);

  const MeshBuffers& buffers = cut->buffers;
  limber_mesh value = LIMBER_MESH_INIT;
  value.frame = state.frame;
  value.vertex_count = buffers.vertex_count();
  value.triangle_count = buffers.triangle_count();
  value.swap_count = static_cast<std::uint32_t>(state.swaps.size());
  value.positions = reinterpret_cast<const float*>(buffers.positions.data());
  value.normals = reinterpret_cast<const float*>(buffers.normals.data());
  value.indices = buffers.indices.data();
  value.nodes = buffers.nodes.data();
  value.labels = (cut->blend ? cut->blend->labels() : cut->cut->labels()).data();
  value.seen_error = view ? cut->cut->seen_error() : 0;
  if ((chosen->fetch & LIMBER_FETCH_LEVELS) != 0) {
    list_levels(state.hierarchy, cut->nodes, cut->levels);
    value.levels = cut->levels.data();
  }
  if ((chosen->fetch & LIMBER_FETCH_ERRORS) != 0) {
    measure_errors(finest, state, *cut->cut, cut->nodes, cut->errors);
    value.errors = cut->errors.of_vertex.data();
    value.rms_error = cut->errors.all;
  }
  if ((chosen->fetch & LIMBER_FETCH_MOVED) != 0) {
    cut->moved.resize(buffers.nodes.size());
    mark_moved(state.swaps, player.old_parents, *cut->cut, cut->scratch.vertex_of_node, cut->moved);
    value.moved = cut->moved.data();
  }
  if (!give(value, mesh)) return player.fail(LIMBER_WRONG_CALL, "limber_cut_update: struct_size is not set");
  return LIMBER_OK;
}
