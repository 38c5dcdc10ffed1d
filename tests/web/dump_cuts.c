// SPDX-License-Identifier: Apache-2.0
// dump_cuts BY AMOUNT [WORD NUMBER...]... <STREAM: all arrays of the cut of every frame, as they lie in memory. What
// players on other machines give is compared with it (player_test.mjs). Words and their numbers are members of a view:
//   eye X Y Z   step X Y Z (of the eye, each frame)   target X Y Z   silhouettes F   away F   focus X Y Z R
//   along AXIS FROM TO   hold 0|1   enough N
// or of the options: blend N
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "limber/player.h"

static void write_array(const void* array, size_t size, size_t count) {
  if (count > 0 && fwrite(array, size, count, stdout) != count) exit(1);
}

static double step[3];

static char** read_numbers(char** words, double* numbers, int count) {
  for (int k = 0; k < count; ++k) numbers[k] = *words ? atof(*words++) : 0;
  return words;
}

static void read_view(char** words, limber_cut_options* options, limber_view* view) {
  double numbers[4];
  while (*words) {
    const char* word = *words++;
    if (strcmp(word, "blend") == 0) {
      options->blend = (uint32_t)atoi(*words++);
      continue;
    }
    options->view = view;
    if (strcmp(word, "eye") == 0) {
      view->criteria |= LIMBER_VIEW_CAMERA;
      words = read_numbers(words, view->eye, 3);
    } else if (strcmp(word, "step") == 0) {
      words = read_numbers(words, step, 3);
    } else if (strcmp(word, "target") == 0) {
      words = read_numbers(words, view->target, 3);
    } else if (strcmp(word, "focus") == 0) {
      view->criteria |= LIMBER_VIEW_FOCUS;
      words = read_numbers(words, numbers, 4);
      memcpy(view->focus_center, numbers, sizeof(view->focus_center));
      view->focus_radius = numbers[3];
    } else if (strcmp(word, "along") == 0) {
      view->criteria |= LIMBER_VIEW_ALONG;
      words = read_numbers(words, numbers, 3);
      view->along_axis = (uint32_t)numbers[0];
      view->along_from = numbers[1];
      view->along_to = numbers[2];
    } else {
      words = read_numbers(words, numbers, 1);
      if (strcmp(word, "silhouettes") == 0) view->silhouettes = (float)numbers[0];
      if (strcmp(word, "away") == 0) view->facing_away = (float)numbers[0];
      if (strcmp(word, "hold") == 0) options->hold = (uint32_t)numbers[0];
      if (strcmp(word, "enough") == 0) options->enough = (float)numbers[0];
    }
  }
}

int main(int argc, char** argv) {
  limber_player* player = limber_player_create();
  limber_cut* cut = limber_cut_create(player);
  limber_cut_options options = LIMBER_CUT_DEFAULTS;
  limber_view view = LIMBER_VIEW_DEFAULTS;
  unsigned char bytes[1 << 16];
  if (argc < 3) return 2;
  options.by = (uint32_t)atoi(argv[1]);
  options.level = (uint32_t)atoi(argv[2]);
  options.budget = (uint32_t)atoi(argv[2]);
  options.error_bound = (float)atof(argv[2]);
  read_view(argv + 3, &options, &view);
  options.fetch = LIMBER_FETCH_LEVELS | LIMBER_FETCH_ERRORS | LIMBER_FETCH_MOVED;
  for (size_t size; (size = fread(bytes, 1, sizeof(bytes), stdin)) > 0;) {
    if (limber_append(player, bytes, size) > LIMBER_NEEDS_MORE) return 3;
  }
  while (limber_step(player) == LIMBER_OK) {
    limber_mesh mesh = LIMBER_MESH_INIT;
    if (limber_cut_update(cut, &options, &mesh) != LIMBER_OK) return 4;
    for (int k = 0; k < 3; ++k) view.eye[k] += step[k];
    const uint32_t counts[] = {mesh.frame, mesh.vertex_count, mesh.triangle_count, mesh.swap_count};
    write_array(counts, sizeof(counts), 1);
    write_array(&mesh.rms_error, sizeof(float), 1);
    write_array(&mesh.seen_error, sizeof(float), 1);
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
