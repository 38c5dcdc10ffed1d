// SPDX-License-Identifier: Apache-2.0
// The main job: a clip in, a stream out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "limber/base/result.h"
#include "limber/clip/clip.h"
#include "limber/hierarchy/build.h"
#include "limber/hierarchy/recluster.h"
#include "limber/stream/encoder.h"
#include "limber/stream/header.h"

namespace limber {

struct BuildStreamOptions {
  // Levels, topology and quadrics; topology and quadrics hold for reclustering, too.
  BuildOptions hierarchy;
  ReclusterOptions recluster;  // its topology and quadrics are those of `hierarchy`, restart.tries_first is unused
  // By how much the quadric error of a node above the finest level may grow to save bytes, as a share of it (leeway.h);
  // beside that, by half the encoder's tolerance. 0: not at all, and nodes are kept within the tolerance.
  double leeway_share = LeewayOptions{}.error_share;
  EncoderOptions encoder;  // its frame numbers, rate, frame count and promises are those of the clip and `hierarchy`
  std::uint32_t base_frames = 8;  // the base hierarchy is made for up to so many frames, spread evenly; >= 1
  unsigned threads = 1;           // 2 or more: reclustering a frame and encoding the one before go on at the same time
};

enum class BuildStage {
  kChoosing,  // reading the clip for the frames of the base hierarchy
  kBase,      // making the base hierarchy
  kFrames,    // reclustering and encoding
};

struct BuildProgress {
  BuildStage stage = BuildStage::kChoosing;
  std::uint32_t frames_done = 0;             // of this stage
  std::optional<std::uint32_t> frame_count;  // of this stage, where known
};

// Called after each frame, at the beginning of each stage and again and again while the base hierarchy is made, on the
// thread of the caller. False: stop.
using BuildProgressFunction = std::function<bool(const BuildProgress&)>;

// Of the numbers of all frames: their mean, and the least that 95 % of them do not exceed.
struct Spread {
  double mean = 0;
  double p95 = 0;
};

// Changes the order of the values; 0 and 0 for none.
Spread spread(std::vector<double>& values);

struct BuildReport {
  std::uint32_t frame_count = 0;
  std::uint32_t base_frame_count = 0;  // that the base hierarchy was made for
  std::vector<Index> level_sizes;      // finest first
  double growth = 0;                   // the exponent in use
  Spread swaps;                        // per frame, from the second on, where the hierarchy was followed
  std::uint32_t restart_count = 0;     // frames, keys all of them, for which it was made anew
  ChunkSizes bytes;                    // of all frames together, by kind
  std::uint64_t stream_bytes = 0;      // of the whole stream; the rest is header, mesh and index

  // Seconds. Where encoding goes on beside the rest, the sum is more than `total`.
  struct Times {
    double base = 0;  // choosing and making
    double reading = 0;
    double reclustering = 0;
    double encoding = 0;
    double total = 0;
  } seconds;
};

// Reads the clip twice (once for the base hierarchy) and writes its stream, strictly forward. Memory grows with the
// mesh, not with the number of frames. The bytes do not depend on `threads`. Preconditions: the reader is before
// frame 0; those of Encoder::begin() and Reclusterer. Errors: those of the reader, the encoder and the sink; kBadInput
// for a clip without frames; kCancelled when `progress` gives false.
Result<BuildReport> build_stream(ClipReader& clip, const BuildStreamOptions& options, const ByteSink& sink,
                                 const BuildProgressFunction& progress = {});

}  // namespace limber
