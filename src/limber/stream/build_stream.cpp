// SPDX-License-Identifier: Apache-2.0
// Kircher & Garland 2005, sections 3 to 5, from end to end:
//
//   choose_base_frames(): frames spread over the clip                        (the paper: the first one)
//   build_hierarchy() for all of them together                               section 3
//   for each frame:
//     follow(): read it, adapt the hierarchy by swaps                        sections 4 and 5
//     encode() it, while the next one is being followed                      docs/format.md
#include "limber/stream/build_stream.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <span>

#include "limber/stream/base_frames.h"

namespace limber {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Error cancelled() { return {ErrorCode::kCancelled, "", "interrupted"}; }

// What the encoder needs of a frame, kept while the reclusterer goes on to the next.
struct FollowedFrame {
  Hierarchy hierarchy;
  std::vector<Swap> swaps;
  std::vector<Vec3f> positions;  // [node_count]
  std::vector<float> errors;     // [node_count]
  std::vector<Leeway> leeways;   // [node_count - vertex_count], or none
  bool is_anew = false;          // the hierarchy does not follow the one before
};

class StreamBuilder {
 public:
  StreamBuilder(ClipReader& clip, const BuildStreamOptions& options, const ByteSink& sink,
                const BuildProgressFunction& progress)
      : clip_(clip), options_(options), progress_(progress), encoder_([this, &sink](std::span<const std::byte> bytes) {
          report_.stream_bytes += bytes.size();
          return sink(bytes);
        }) {}

  Result<BuildReport> run();

 private:
  bool go_on(BuildStage stage, std::uint32_t frames_done) const {
    return !progress_ || progress_({stage, frames_done, stage == BuildStage::kBase ? std::nullopt : frame_count_});
  }

  Result<void> make_base();
  Result<bool> follow(FollowedFrame& frame);
  Result<void> encode(const FollowedFrame& frame);
  double leeway_distance();
  Result<void> begin(const FollowedFrame& first);

  ClipReader& clip_;
  const BuildStreamOptions& options_;
  const BuildProgressFunction& progress_;
  Encoder encoder_;
  BuildReport report_;
  std::optional<std::uint32_t> frame_count_;
  std::unique_ptr<Reclusterer> reclusterer_;
  std::vector<Vec3f> input_;         // [vertex_count]
  double diagonal_ = 0;              // of the first frame
  std::vector<double> swap_counts_;  // of the frames from the second on
};

Result<void> StreamBuilder::make_base() {
  frame_count_ = clip_.frame_count();
  if (!go_on(BuildStage::kChoosing, 0)) return cancelled();
  Result<BaseFrames> base = choose_base_frames(clip_, options_.base_frames, [this](std::uint32_t frames_read) {
    return go_on(BuildStage::kChoosing, frames_read);
  });
  if (!base) return base.error();
  if (base->frame_count > 0) frame_count_ = base->frame_count;
  if (!go_on(BuildStage::kBase, 0)) return cancelled();
  report_.base_frame_count = static_cast<std::uint32_t>(base->positions.size());
  const std::vector<std::span<const Vec3f>> frames(base->positions.begin(), base->positions.end());
  Result<Hierarchy> hierarchy =
      build_hierarchy(clip_.mesh(), frames, options_.hierarchy, [this] { return go_on(BuildStage::kBase, 0); });
  if (!hierarchy) return hierarchy.error();
  for (Index level = 0; level < hierarchy->level_count(); ++level)
    report_.level_sizes.push_back(hierarchy->level_size(level));
  ReclusterOptions recluster = as_contracted(options_.recluster, options_.hierarchy.contract);
  recluster.restart.tries_first = frames.size() > 1;
  reclusterer_ = std::make_unique<Reclusterer>(clip_.mesh(), std::move(*hierarchy), recluster);
  return clip_.rewind();
}

// The tolerance is relative to the diagonal of the first frame.
double StreamBuilder::leeway_distance() {
  if (report_.frame_count == 0) {
    Box box;
    for (const Vec3f& position : input_) box.add(Vec3d(position));
    diagonal_ = box.diagonal();
  }
  return options_.encoder.tolerance * diagonal_ / 2;
}

// Gives false after the last frame.
Result<bool> StreamBuilder::follow(FollowedFrame& frame) {
  const Clock::time_point start = Clock::now();
  const Result<bool> more = clip_.read(input_);
  report_.seconds.reading += seconds_since(start);
  if (!more || !*more) return more;
  const Clock::time_point read = Clock::now();
  const std::span<const Swap> swaps = reclusterer_->step(input_);
  frame.swaps.assign(swaps.begin(), swaps.end());
  frame.hierarchy = reclusterer_->hierarchy();
  frame.positions.assign(reclusterer_->positions().begin(), reclusterer_->positions().end());
  frame.errors.assign(reclusterer_->errors().begin(), reclusterer_->errors().end());
  if (options_.leeway_share > 0 && !options_.encoder.lossless) {
    frame.leeways.resize(frame.errors.size() - input_.size());
    reclusterer_->measure_leeways({options_.leeway_share, leeway_distance()}, frame.leeways);
  }
  // In the first frame, swaps are improvements of the base hierarchy, which is stored with them.
  frame.is_anew = reclusterer_->has_restarted();
  if (report_.frame_count++ > 0) {
    if (frame.is_anew)
      ++report_.restart_count;
    else
      swap_counts_.push_back(static_cast<double>(swaps.size()));
  }
  report_.seconds.reclustering += seconds_since(read);
  return true;
}

Result<void> StreamBuilder::begin(const FollowedFrame& first) {
  EncoderOptions options = options_.encoder;
  options.first_frame_number = clip_.first_frame_number();
  options.frames_per_second = clip_.frames_per_second();
  options.frame_count = frame_count_;
  options.manifold_kept = options_.hierarchy.contract.topology == Topology::kPreserve;
  return encoder_.begin(clip_.mesh(), first.hierarchy, input_, options);
}

Result<void> StreamBuilder::encode(const FollowedFrame& frame) {
  const Clock::time_point start = Clock::now();
  Result<void> added =
      encoder_.add(frame.hierarchy, frame.swaps, frame.positions, frame.errors, frame.leeways, frame.is_anew);
  if (!added) return added;
  const ChunkSizes sizes = encoder_.sizes();
  report_.bytes.hierarchy += sizes.hierarchy;
  report_.bytes.finest_positions += sizes.finest_positions;
  report_.bytes.coarser_positions += sizes.coarser_positions;
  report_.bytes.errors += sizes.errors;
  report_.bytes.overhead += sizes.overhead;
  report_.seconds.encoding += seconds_since(start);
  return added;
}

Result<BuildReport> StreamBuilder::run() {
  const Clock::time_point start = Clock::now();
  if (Result<void> made = make_base(); !made) return made.error();
  report_.seconds.base = seconds_since(start);

  input_.resize(clip_.mesh().vertex_count);
  std::array<FollowedFrame, 2> slots;
  Result<bool> more = follow(slots[0]);
  if (!more) return more.error();
  if (!*more) return Error{ErrorCode::kBadInput, "", "the clip has no frames"};
  if (Result<void> begun = begin(slots[0]); !begun) return begun.error();
  const auto policy = options_.threads > 1 ? std::launch::async : std::launch::deferred;
  for (std::uint32_t frame = 0; *more; ++frame) {
    std::future<Result<void>> encoding = std::async(policy, [this, &slot = slots[frame % 2]] { return encode(slot); });
    more = follow(slots[(frame + 1) % 2]);
    if (Result<void> encoded = encoding.get(); !encoded) return encoded.error();
    if (!more) return more.error();
    if (!go_on(BuildStage::kFrames, frame + 1)) return cancelled();
  }
  if (Result<void> finished = encoder_.finish(); !finished) return finished.error();

  report_.growth = reclusterer_->growth();
  report_.swaps = spread(swap_counts_);
  report_.seconds.total = seconds_since(start);
  return std::move(report_);
}

}  // namespace

Spread spread(std::vector<double>& values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  return {sum / static_cast<double>(values.size()), values[rank - 1]};
}

Result<BuildReport> build_stream(ClipReader& clip, const BuildStreamOptions& options, const ByteSink& sink,
                                 const BuildProgressFunction& progress) {
  assert(options.base_frames >= 1);
  return StreamBuilder(clip, options, sink, progress).run();
}

}  // namespace limber
