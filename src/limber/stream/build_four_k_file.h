// SPDX-License-Identifier: Apache-2.0
// A clip in, or a single mesh, a four-face file out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "limber/base/result.h"
#include "limber/clip/clip.h"
#include "limber/fourface/build_four_k.h"
#include "limber/stream/build_stream.h"
#include "limber/stream/four_k_encoder.h"

namespace limber {

struct BuildFourKOptions {
  FourKOptions structure;
  std::optional<double> crease_cosine;  // edges whose triangles' normals have an angle with a lesser cosine are lines
  FourKEncoderOptions encoder;          // its numbers of parts and frames, and its rate, are those of the clip
  std::uint32_t base_frames = 8;        // the structure is made for up to so many frames, spread evenly; >= 1
};

struct BuildFourKReport {
  std::uint32_t frame_count = 0, base_frame_count = 0;
  Index vertex_count = 0;    // of the input
  Index finest_count = 0;    // triangles, without degenerate ones
  Index coarsest_count = 0;  // triangles
  Index operation_count = 0, level_count = 0;
  FourKHeight height;
  std::uint64_t file_bytes = 0;
  std::uint64_t structure_bytes = 0;  // of these, all but the other frames
  double build_seconds = 0;           // of the structure ...
  double total_seconds = 0;           // ... and altogether
};

// Precondition: the reader is before frame 0. progress: as for build_stream(). Errors: those of the reader and the
// sink; kBadInput for a clip without frames; kCancelled.
Result<BuildFourKReport> build_four_k_file(ClipReader& clip, const BuildFourKOptions& options, const ByteSink& sink,
                                           const BuildProgressFunction& progress = {});

}  // namespace limber
