// SPDX-License-Identifier: Apache-2.0
// dump_cuts BY AMOUNT <STREAM: all arrays of the cut of every frame, as they lie in memory. What players on other
// machines give is compared with it (player_test.mjs).
#include <stdio.h>
#include <stdlib.h>

#include "limber/player.h"

static void write_array(const void* array, size_t size, size_t count) {
  if (count > 0 && fwrite(array, size, count, stdout) != count) exit(1);
}

int main(int argc, char** argv) {
  limber_player* player = limber_player_create();
  limber_cut* cut = limber_cut_create(player);
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  unsigned char bytes[1 << 16];
  if (argc != 3) return 2;
  options.by = (uint32_t)atoi(argv[1]);
  options.level = (uint32_t)atoi(argv[2]);
  options.budget = (uint32_t)atoi(argv[2]);
  options.error_bound = (float)atof(argv[2]);
  options.fetch = LIMBER_FETCH_LEVELS | LIMBER_FETCH_ERRORS | LIMBER_FETCH_MOVED;
  for (size_t size; (size = fread(bytes, 1, sizeof(bytes), stdin)) > 0;) {
    if (limber_append(player, bytes, size) > LIMBER_NEEDS_MORE) return 3;
  }
  while (limber_step(player) == LIMBER_OK) {
    limber_mesh mesh = LIMBER_MESH_INIT;
    if (limber_cut_update(cut, &options, &mesh) != LIMBER_OK) return 4;
    const uint32_t counts[] = {mesh.frame, mesh.vertex_count, mesh.triangle_count, mesh.swap_count};
    write_array(counts, sizeof(counts), 1);
    write_array(&mesh.rms_error, sizeof(float), 1);
    write_array(mesh.positions, 3 * sizeof(float), mesh.vertex_count);
    write_array(mesh.normals, 3 * sizeof(float), mesh.vertex_count);
    write_array(mesh.indices, 3 * sizeof(uint32_t), mesh.triangle_count);
    write_array(mesh.nodes, sizeof(uint32_t), mesh.vertex_count);
    write_array(mesh.levels, 1, mesh.vertex_count);
    write_array(mesh.errors, sizeof(float), mesh.vertex_count);
    write_array(mesh.moved, 1, mesh.vertex_count);
  }
  limber_cut_destroy(cut);
  limber_player_destroy(player);
  return 0;
}
