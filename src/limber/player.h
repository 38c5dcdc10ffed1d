// SPDX-License-Identifier: Apache-2.0
// limber's player for C, and for all that can call C: WebAssembly exports these functions.
//
//   limber_player* player = limber_player_create();
//   limber_cut* cut = limber_cut_create(player);
//   while (bytes arrive) {
//     if (limber_append(player, bytes, size) > LIMBER_NEEDS_MORE) stop(limber_error(player));
//     while (limber_step(player) == LIMBER_OK) {
//       limber_cut_options options = LIMBER_CUT_DEFAULTS;    // by level, or:
//       options.by = LIMBER_BY_VERTICES;
//       options.budget = 800;
//       limber_mesh mesh = LIMBER_MESH_INIT;
//       limber_cut_update(cut, &options, &mesh);
//       draw(mesh.positions, mesh.indices);
//     }
//   }
//   limber_cut_destroy(cut);
//   limber_player_destroy(player);
//
// What is seen from an eye, by no more than two pixels of error:
//
//   limber_view view = LIMBER_VIEW_DEFAULTS;
//   view.criteria = LIMBER_VIEW_CAMERA;
//   view.eye[2] = 3;
//   options.by = LIMBER_BY_ERROR;
//   options.error_bound = 2;
//   options.view = &view;
//
// Link with limber_player and the C++ standard library: cc play.c $(pkg-config --cflags --libs limber-player) -lstdc++
//
// A player and its cuts belong to one thread at a time; different players know nothing of each other. Once all bytes
// are there and every function has met its largest frame, nothing allocates. Nothing throws. What a stream announces is
// allocated in proportion to the bytes that are there (docs/format.md); where the system refuses that, the program
// ends.
//
// Structures begin with `struct_size`, which the _INIT and _DEFAULTS macros set. Later versions add members at the end:
// a program compiled against an older header goes on as before.
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// "No such frame", "not known".
#define LIMBER_NONE 0xffffffffu

typedef enum limber_status {
  LIMBER_OK = 0,
  LIMBER_NEEDS_MORE = 1,   // not an error: bytes are not there yet, see limber_missing()
  LIMBER_BAD_STREAM = 2,   // the bytes break a rule of the format
  LIMBER_UNSUPPORTED = 3,  // well formed, but for a newer limber
  LIMBER_NO_MEMORY = 4,    // for the bytes of the stream
  LIMBER_WRONG_CALL = 5    // arguments, or an order of calls, that the contract rules out; nothing was done
} limber_status;

typedef struct limber_player limber_player;
typedef struct limber_cut limber_cut;

limber_player* limber_player_create(void);

// Null is allowed. The player's cuts are destroyed before it.
void limber_player_destroy(limber_player* player);

// One line about the last call with this player, or a cut of it, that did not give LIMBER_OK: the place in the stream
// and the rule broken. Valid until the next call.
const char* limber_error(const limber_player* player);

// ---- Bytes. Either in their order, as they arrive, with limber_append(). Or, of a stream whose size is known, from
// any place in any order: limber_missing() says which are needed next, and limber_supply() takes them. Both may be
// mixed. Bytes are copied; those that are there already are skipped.
//
// All three give LIMBER_NEEDS_MORE until header and mesh are there, and LIMBER_OK from then on. As soon as frame 0 is
// there, and no other is shown, it is. An error is final for the bytes: no more are taken, and later calls give it
// again; frames that were available stay so.

limber_status limber_append(limber_player* player, const void* bytes, size_t size);

// How long the whole stream is, in bytes, where that is known: at any time, once. All of it is reserved.
limber_status limber_set_size(limber_player* player, uint64_t size);

// Precondition: limber_set_size() was called, and offset + size is within it.
limber_status limber_supply(limber_player* player, uint64_t offset, const void* bytes, size_t size);

typedef struct limber_range {
  uint64_t offset;
  uint64_t size;  // 0: all that there is from offset on
} limber_range;

// LIMBER_OK where all is there to seek `frame`; LIMBER_NEEDS_MORE with the first bytes that are not: of the header and
// the mesh; then, where the size of the stream is known, of the index at its end; then of the frames from the key at or
// before `frame` on, or from the frame shown. Call it again when these have come. With LIMBER_NONE only header, mesh
// and index are asked for. LIMBER_BAD_STREAM where the stream has a known size and ends too early.
limber_status limber_missing(const limber_player* player, uint32_t frame, limber_range* range);

// ---- What the stream says about itself. LIMBER_NEEDS_MORE until header and mesh are there.

#define LIMBER_MOST_LEVELS 32

typedef struct limber_info {
  uint32_t struct_size;
  uint32_t frame_count;         // LIMBER_NONE where it is not known yet
  uint32_t available_frames;    // 0 to this - 1 are known; with an index, their bytes need not be there
  uint32_t first_frame_number;  // that the source gave to frame 0
  double frames_per_second;
  double tolerance;       // no vertex is further from the original, in units of the input; 0: lossless
  double diagonal;        // of the bounding box of frame 0, in units of the input
  uint64_t size;          // of the stream; 0 where it is not known
  uint64_t bytes_there;   // of it
  uint32_t has_index;     // 1: all frames are known
  uint32_t key_interval;  // a key comes at least every so many frames
  uint32_t vertex_count;  // of the finest level
  uint32_t triangle_count;
  uint32_t node_count;  // of all levels
  uint32_t level_count;
  uint32_t level_size[LIMBER_MOST_LEVELS];  // nodes, finest level first; 0 above the top
} limber_info;

#define LIMBER_INFO_INIT                                                 \
  {                                                                      \
    sizeof(limber_info), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, { 0 } \
  }

limber_status limber_get_info(const limber_player* player, limber_info* info);

typedef struct limber_frame {
  uint32_t struct_size;
  uint32_t key;       // the frame at or before this one that can be decoded alone: where seeking starts
  uint32_t is_there;  // 1: all bytes of this frame's chunk are
  uint32_t unused;
  uint64_t offset;  // of the frame's chunk in the stream
  uint64_t size;    // of it, in bytes
} limber_frame;

#define LIMBER_FRAME_INIT \
  { sizeof(limber_frame), 0, 0, 0, 0, 0 }

// LIMBER_NEEDS_MORE where the frame is not available yet.
limber_status limber_get_frame(const limber_player* player, uint32_t frame, limber_frame* info);

// ---- Playing.

// The frame shown; LIMBER_NONE before the first is there, and after a damaged one.
uint32_t limber_shown_frame(const limber_player* player);

// Shows a frame: decodes from the key at or before it, or onwards from the frame shown where that is nearer.
// LIMBER_NEEDS_MORE, and all stays as it is, where bytes for that are not there. LIMBER_BAD_STREAM: no frame is shown;
// any other seek may follow. LIMBER_WRONG_CALL: the stream has no such frame.
limber_status limber_seek(limber_player* player, uint32_t frame);

// Shows the frame after the one shown; frame 0 where none is. The first limber_step() after limber_player_create()
// gives frame 0, though the bytes' arrival shows it already: so a loop over limber_step() meets every frame.
// LIMBER_NEEDS_MORE also after the last frame.
limber_status limber_step(limber_player* player);

// ---- Levels of detail. A player can have several cuts, each of its own level of detail.

// Which member of limber_cut_options chooses.
enum {
  LIMBER_BY_LEVEL = 0,      // the nodes of `level`
  LIMBER_BY_VERTICES = 1,   // at most `budget` vertices, and the least error that they allow
  LIMBER_BY_TRIANGLES = 2,  // at most `budget` triangles, and the least error that they allow
  LIMBER_BY_ERROR = 3       // the coarsest nodes within `error_bound`
};

// What of a limber_view matters; added up.
enum { LIMBER_VIEW_CAMERA = 1, LIMBER_VIEW_FOCUS = 2, LIMBER_VIEW_ALONG = 4 };

// How a cut is looked at: where its errors matter, and by how much. The criteria combine: how many times larger an
// error may be at a place is multiplied. With a camera errors are in pixels: a distance counts as if it lay across the
// line of sight, and outside the picture half of the distance to what is seen is allowed on top. Without one they are
// in percent of the diagonal of the frame's bounding box. Lengths and places are in units of the input, and below 1e18.
typedef struct limber_view {
  uint32_t struct_size;
  uint32_t criteria;  // LIMBER_VIEW_...: which of the members below are looked at

  double eye[3];       // LIMBER_VIEW_CAMERA: where the eye is,
  double target[3];    // what it looks at, which is in the middle of the picture,
  double up[3];        // and what points up in it
  double fov_degrees;  // vertical, in (0, 120]
  uint32_t width;      // of the picture, in pixels, >= 1
  uint32_t height;
  float silhouettes;  // >= 1: how many times smaller an error must be on the silhouette
  float facing_away;  // >= 1: how many times larger it may be where the surface faces away

  double focus_center[3];  // LIMBER_VIEW_FOCUS: finest in a ball,
  double focus_radius;     // > 0; one radius beyond it
  float focus_outside;     // errors may be so many times larger, >= 1

  float along_coarsest;  // LIMBER_VIEW_ALONG: errors may be so many times larger, >= 1,
  double along_from;     // towards one end of an axis: not at all at and before this place,
  double along_to;       // all of it at and beyond this one, which may be less than the other
  uint32_t along_axis;   // 0, 1, 2: x, y, z
  uint32_t unused;
} limber_view;

#define LIMBER_VIEW_DEFAULTS \
  { sizeof(limber_view), 0, {0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 24, 1200, 900, 1, 1, {0, 0, 0}, 1, 32, 64, 0, 1, 0, 0 }

// What to fetch besides positions, normals, indices and nodes; added up.
enum {
  LIMBER_FETCH_LEVELS = 1,
  LIMBER_FETCH_ERRORS = 2,  // takes a pass over all triangles of the finest level
  LIMBER_FETCH_MOVED = 4
};

typedef struct limber_cut_options {
  uint32_t struct_size;
  uint32_t by;
  uint32_t level;     // 0 is the finest; clamped to the top
  uint32_t budget;    // the top level is the coarsest there is, whatever the budget
  float error_bound;  // root mean square distance, in percent of the frame's bounding box diagonal, >= 0; with a view
                      // the largest distance, in the view's unit
  float hysteresis;   // >= 1: how many times better, in squared error, a change must be; 1: no memory
  uint32_t fetch;     // LIMBER_FETCH_...

  // With a view a budget gives the least of the largest errors that it allows, as far as they are estimated.
  uint32_t hold;            // LIMBER_BY_ERROR with a view: 0, errors are estimated; 1, they are measured until they are
                            // within the bound (docs/design.md, "Looking"), which takes many times as long
  float enough;             // a budget with a view: the error that none of it is spent on going below, >= 0
  const limber_view* view;  // null: not looked at. Read by limber_cut_update() and not kept

  // How many frames a change takes: vertices move there from where they were. 0 and 1: changes are shown at once. They
  // are on their way while each update is of the frame after the one before, or of the same, with the same of the
  // members above, but for hysteresis, fetch and view; else the cut is shown as it is. A mesh has more vertices than
  // the budget while some are on their way: on a galloping horse of 800, at 4 frames, a tenth; on a cloth
  // that falls, at 8, more than twice as many.
  uint32_t blend;
  uint32_t unused;
} limber_cut_options;

#define LIMBER_CUT_DEFAULTS \
  { sizeof(limber_cut_options), LIMBER_BY_LEVEL, 0, 0, 1.0f, 1.6f, 0, 0, 0.0f, NULL, 0, 0 }

// Arrays belong to the cut and are valid until its next update. Vertices are in rising order of their nodes.
typedef struct limber_mesh {
  uint32_t struct_size;
  uint32_t frame;
  uint32_t vertex_count;
  uint32_t triangle_count;
  uint32_t swap_count;  // nodes, of all levels, that changed their parents in this frame; 0 at a key
  float rms_error;  // root mean square distance to the surface, in units of the input; 0 without LIMBER_FETCH_ERRORS
  const float* positions;   // [3 x vertex_count], in units of the input
  const float* normals;     // [3 x vertex_count], of length 1
  const uint32_t* indices;  // [3 x triangle_count], counter-clockwise seen from outside
  const uint32_t* nodes;    // [vertex_count]: the same number is the same vertex from frame to frame; below
                            // limber_info.vertex_count it is a vertex of the input; from limber_info.node_count on it
                            // is one on its way, until it arrives: its level and its errors are of where it goes
  const uint8_t* levels;    // [vertex_count]: 0 is the finest; null where not fetched
  const float* errors;   // [vertex_count]: root mean square distance to the part of the surface that the vertex stands
                         // for, in units of the input; null where not fetched
  const uint8_t* moved;  // [vertex_count]: 1 where this frame's swaps gave the vertex another part of the surface;
                         // null where not fetched
  const uint32_t* labels;  // [limber_info.vertex_count]: the node that stands for each vertex of the input; it is not
                           // among `nodes` where it is a corner of no triangle
  float seen_error;  // with a view: where the bound is held, a bound of what is seen; else the largest estimate of
                     // a node of the cut; in the view's unit. 0 without
} limber_mesh;

#define LIMBER_MESH_INIT \
  { sizeof(limber_mesh), 0, 0, 0, 0, 0, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0 }

limber_cut* limber_cut_create(limber_player* player);
void limber_cut_destroy(limber_cut* cut);  // null is allowed

// Cuts the frame shown. LIMBER_NEEDS_MORE where none is shown. LIMBER_WRONG_CALL where options, or those of the view
// that are looked at, are outside their ranges.
limber_status limber_cut_update(limber_cut* cut, const limber_cut_options* options, limber_mesh* mesh);

#ifdef __cplusplus
}
#endif
