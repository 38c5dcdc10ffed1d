// SPDX-License-Identifier: Apache-2.0
// Methods side by side on one clip, in one run.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/clip_measure.h"
#include "eval/methods/method.h"
#include "eval/methods/quadric_error.h"
#include "eval/methods/seen_frames.h"
#include "limber/base/result.h"

namespace limber::eval {

// What a method did, beside what ClipMeasure says of it.
struct MethodFrame {
  Index vertex_count = 0;
  std::optional<double> quadric_error;  // see QuadricError; nothing where the method does not tell its clusters
  double adapt_seconds = 0;             // see Approximation
  double extract_seconds = 0;
  std::size_t choice_bytes = 0;  // see Approximation
};

struct Contender {
  const MethodInfo* info = nullptr;
  std::unique_ptr<Method> method;
  double begin_seconds = 0;     // processor time
  Approximation approximation;  // of the frame added last
  ClipMeasure measure;
  std::vector<MethodFrame> frames;  // as many as measure.frames()
};

// Over the frames; nothing where the method does not tell its clusters.
std::optional<Statistic> quadric_errors(const Contender& contender);

// A contender against the first one.
struct Relative {
  double rms_by_frame = 1;                  // mean over the frames of rms / rms
  double rms_by_mean = 1;                   // mean rms / mean rms
  double rms_worst = 1;                     // the largest rms / rms of a frame
  std::optional<double> quadric_error = 1;  // mean / mean; nothing where one of them has none
  double adapt_time = 1;                    // mean / mean
};

// The rms of a frame over that of another approximation of it; where both are nothing, 1.
double rms_ratio(const FrameMeasure& frame, const FrameMeasure& first);

class Comparison {
 public:
  // At least one method; the first is what the others are held against.
  Comparison(std::span<const MethodInfo* const> methods, const MethodOptions& options,
             const ClipMeasureOptions& measure);

  // As Method::begin(). `seen` was read for these methods, all of which support the mesh.
  void begin(const Mesh& mesh, const SeenFrames& seen);

  // Runs every method on the next frame, one after the other on this thread so that times can be compared, and measures
  // the results on all threads. Error kBadInput: the frame has no extent, or nothing is left of it at this size.
  Result<void> add(std::span<const Vec3f> positions);

  std::span<const Contender> contenders() const { return contenders_; }

  // Precondition: a frame has been added. Where both are nothing their ratio is 1.
  Relative relative(std::size_t contender) const;

 private:
  const Mesh* mesh_ = nullptr;
  MethodOptions options_;
  std::uint32_t first_frame_number_;
  std::optional<QuadricError> quadric_error_;
  std::vector<Contender> contenders_;
  std::vector<Triangle> ids_;  // scratch
};

// Schema "limber.simplify/1": `methods`, each with its name, the summary and the frames of "limber.measure/1",
// `vertices`, `quadric_error`, `begin_ms`, `adapt_ms` and `extract_ms` (mean, 95th percentile and worst), and
// `relative` to the first method; null where there is no value. Precondition of both: a frame has been added.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

// A line per method; then, of several, a line per method relative to the first.
std::string comparison_table(const Comparison& comparison);

}  // namespace limber::eval
