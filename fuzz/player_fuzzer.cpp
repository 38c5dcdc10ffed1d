// SPDX-License-Identifier: Apache-2.0
// limber/player.h with any bytes, in any order of calls. The input is a stream and after it a script of kScriptSize
// bytes: which bytes of the stream come when, and what is asked meanwhile. Checksums are made right first. Whatever is
// given, a mesh that comes back must be one.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <span>
#include <vector>

#include "fuzz/seal_chunks.h"
#include "limber/player.h"

namespace {

constexpr std::size_t kScriptSize = 96;

void require(bool holds) {
  if (!holds) std::abort();
}

// The script; 0 after its end.
class Script {
 public:
  explicit Script(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool has_more() const { return at_ < bytes_.size(); }
  std::uint8_t next() { return has_more() ? bytes_[at_++] : 0; }

  // Mostly small, sometimes as large or as odd as can be.
  double number() {
    constexpr double kOdd[] = {0, -0.0, 1e-30, 1e-6, 1e6, 9e17, -9e17, 1e18, 1e300, HUGE_VAL, NAN};
    const std::uint8_t byte = next();
    return byte < std::size(kOdd) ? kOdd[byte] : (byte - 128) / 16.0;
  }
  void place(double (&to)[3]) {
    for (double& x : to) x = number();
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

limber_view make_view(Script& script) {
  limber_view view = LIMBER_VIEW_DEFAULTS;
  view.criteria = script.next() & 7u;
  if ((view.criteria & LIMBER_VIEW_CAMERA) != 0) {
    script.place(view.eye);
    script.place(view.target);
    view.fov_degrees = script.number() * 8;
    view.height = script.next() * 8u;
    view.silhouettes = 1 + static_cast<float>(script.next()) / 16;
    view.facing_away = static_cast<float>(script.number());
  }
  if ((view.criteria & LIMBER_VIEW_FOCUS) != 0) {
    script.place(view.focus_center);
    view.focus_radius = script.number();
  }
  if ((view.criteria & LIMBER_VIEW_ALONG) != 0) {
    view.along_axis = script.next() & 3u;
    view.along_from = script.number();
    view.along_to = script.number();
  }
  return view;
}

// Where changes are blended the numbers of nodes go on with those of vertices on their way.
void require_mesh(const limber_mesh& mesh, const limber_info& info, bool blends) {
  const std::uint32_t node_end = info.node_count + (blends ? info.vertex_count : 0);
  require(mesh.vertex_count <= node_end && mesh.triangle_count <= info.triangle_count);
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    require(mesh.nodes[v] < node_end && (v == 0 || mesh.nodes[v - 1] < mesh.nodes[v]));
    if (mesh.levels) require(mesh.levels[v] < info.level_count);
    if (mesh.nodes[v] >= info.node_count) continue;
    for (std::size_t k = 0; k < 3; ++k) require(std::isfinite(mesh.positions[3 * std::size_t{v} + k]));
  }
  for (std::size_t i = 0; i < 3 * std::size_t{mesh.triangle_count}; ++i) require(mesh.indices[i] < mesh.vertex_count);
  for (std::uint32_t v = 0; v < info.vertex_count; ++v) require(mesh.labels[v] < node_end);
}

void update(limber_player* player, limber_cut* cut, Script& script) {
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  const std::uint8_t how = script.next();
  options.by = how & 3u;
  options.hold = how >> 2 & 1u;
  options.fetch = how >> 3 & 7u;
  const std::uint8_t amount = script.next();
  options.level = amount & 15u;
  options.budget = amount * 2u;
  options.error_bound = static_cast<float>(amount) / 16;
  options.blend = script.next() & 7u;
  const limber_view view = make_view(script);
  if ((how & 64u) == 0) options.view = &view;
  limber_mesh mesh = LIMBER_MESH_INIT;
  limber_info info = LIMBER_INFO_INIT;
  if (limber_cut_update(cut, &options, &mesh) != LIMBER_OK) return;
  require(limber_get_info(player, &info) == LIMBER_OK && mesh.frame == limber_shown_frame(player));
  require_mesh(mesh, info, options.blend > 1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kScriptSize) return 0;
  const auto input = std::as_bytes(std::span(data, size - kScriptSize));
  std::vector<std::byte> bytes(input.begin(), input.end());
  limber::seal_chunks(bytes);
  Script script(std::span(data + size - kScriptSize, kScriptSize));
  limber_player* player = limber_player_create();
  limber_cut* cuts[] = {limber_cut_create(player), limber_cut_create(player)};
  std::size_t appended = 0;
  while (script.has_more()) {
    limber_range range;
    limber_frame frame = LIMBER_FRAME_INIT;
    switch (script.next() & 7u) {
      case 0: {
        const std::size_t more = std::min<std::size_t>(script.next() * 64u, bytes.size() - appended);
        if (limber_append(player, bytes.data() + appended, more) <= LIMBER_NEEDS_MORE) appended += more;
        break;
      }
      case 1:
        limber_set_size(player, bytes.size());
        break;
      case 2:
        limber_seek(player, script.next());
        break;
      case 3:
        if (limber_missing(player, script.next(), &range) == LIMBER_NEEDS_MORE && range.offset <= bytes.size())
          limber_supply(player, range.offset, bytes.data() + range.offset,
                        std::min<std::uint64_t>(range.size, bytes.size() - range.offset));
        break;
      case 4:
        limber_step(player);
        break;
      case 5:
      case 6:
        update(player, cuts[script.next() & 1u], script);
        break;
      default:
        limber_get_frame(player, script.next(), &frame);
        break;
    }
  }
  for (limber_cut* cut : cuts) limber_cut_destroy(cut);
  limber_player_destroy(player);
  return 0;
}
