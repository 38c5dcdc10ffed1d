// SPDX-License-Identifier: Apache-2.0
// Plays a stream as it arrives on standard input, at 800 vertices: limber/player.h in plain C.
//
//   example_play_in_c <horse.limber
#include <stdio.h>

#include "limber/player.h"

int main(void) {
  limber_player* player = limber_player_create();
  limber_cut* cut = limber_cut_create(player);
  unsigned char bytes[4096];
  int failed = 0;
  for (size_t size; !failed && (size = fread(bytes, 1, sizeof(bytes), stdin)) > 0;) {
    failed = limber_append(player, bytes, size) > LIMBER_NEEDS_MORE;
    limber_status stepped;
    while (!failed && (stepped = limber_step(player)) != LIMBER_NEEDS_MORE) {
      limber_cut_options options = LIMBER_CUT_DEFAULTS;
      options.by = LIMBER_BY_VERTICES;
      options.budget = 800;
      limber_mesh mesh = LIMBER_MESH_INIT;
      failed = stepped != LIMBER_OK || limber_cut_update(cut, &options, &mesh) != LIMBER_OK;
      if (!failed)
        printf("frame %u: %u swaps, %u vertices, %u triangles\n", mesh.frame, mesh.swap_count, mesh.vertex_count,
               mesh.triangle_count);
    }
  }
  if (failed || limber_shown_frame(player) == LIMBER_NONE) fprintf(stderr, "%s\n", limber_error(player));
  failed = failed || limber_shown_frame(player) == LIMBER_NONE;
  limber_cut_destroy(cut);
  limber_player_destroy(player);
  return failed;
}
