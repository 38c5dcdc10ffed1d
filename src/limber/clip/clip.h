// SPDX-License-Identifier: Apache-2.0
// A clip: one connectivity, many frames, read one frame at a time and never as a whole.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "limber/base/mesh.h"
#include "limber/base/result.h"
#include "limber/base/vec.h"

namespace limber {

// Frames in, one at a time. A reader is positioned before frame 0 when it is opened.
class ClipReader {
 public:
  virtual ~ClipReader() = default;

  // The connectivity; the same object for the life of the reader.
  virtual const Mesh& mesh() const = 0;

  // The number of frames, where the source knows it without reading them all.
  virtual std::optional<std::uint32_t> frame_count() const = 0;

  // Reads the next frame into `positions` ([mesh().vertex_count], finite) and gives true; gives false, and
  // leaves `positions` alone, after the last one. An error names the file and the place in it.
  virtual Result<bool> read(std::span<Vec3f> positions) = 0;

  // Back to before frame 0.
  virtual Result<void> rewind() = 0;

  // Frames per second; 24 where the source does not say.
  virtual double frames_per_second() const { return 24.0; }

  // The number that the source gives to its first frame (the 12 of `0012.obj`); outputs are numbered likewise.
  virtual std::uint32_t first_frame_number() const { return 0; }
};

struct ClipOptions {
  std::string mesh;  // the base mesh of a point cache; empty: the only mesh beside it
  // The first and last frame numbers to read, as the source numbers them.
  std::optional<std::uint32_t> first;
  std::optional<std::uint32_t> last;
  std::uint32_t step = 1;  // of these, the first and every step-th after it; >= 1. The rate is lowered to suit
};

// Opens whatever the specification names: a printf pattern, glob or folder of .obj/.ply/.off frames; a .pc2 or
// .mdd with its mesh, or the folder that holds just these; a generated `sample:NAME?vertices=N&frames=N`; a single
// mesh (a clip of one frame).
// A specification that names none of them, and a source whose first frame breaks a rule, give an error; so do, when
// they are read, frames of another connectivity than the first (kMismatch).
Result<std::unique_ptr<ClipReader>> open_clip(std::string_view specification, const ClipOptions& options);

// Frames out, one at a time. Nothing is at the final name until finish() succeeds; a writer destroyed
// before that leaves nothing behind.
class ClipWriter {
 public:
  virtual ~ClipWriter() = default;

  // Appends a frame: `positions` is [vertex_count] of the mesh given when the writer was created.
  virtual Result<void> write(std::span<const Vec3f> positions) = 0;

  // Makes the output whole and gives it its final name.
  virtual Result<void> finish() = 0;
};

struct ClipWriterOptions {
  bool replace = false;  // may an existing output be replaced?
  std::uint32_t first_frame_number = 0;
  double frames_per_second = 24.0;
};

// The format comes from the name: `out/%04d.obj|ply|off` (or `out.obj` for a single frame), `out.pc2`, `out.mdd` (the
// last two write the mesh of the first frame beside them, as out.obj). An output that is there already is kExists
// unless options.replace; a clip without frames is kBadInput when it is finished.
Result<std::unique_ptr<ClipWriter>> create_clip(std::string_view path, const Mesh& mesh,
                                                const ClipWriterOptions& options);

}  // namespace limber
