// SPDX-License-Identifier: Apache-2.0
// Levels of detail out of a stream file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "eval/level_choice.h"
#include "limber/base/result.h"
#include "limber/view/blend.h"
#include "limber/view/extract.h"
#include "limber/view/player.h"

namespace limber::eval {

class StreamLevels {
 public:
  // Reads the file; every frame is cut at the finest level. Errors name the file; kTruncated where not even one frame
  // is whole.
  static Result<std::unique_ptr<StreamLevels>> open(const std::filesystem::path& path);

  // How the frames are cut from now on.
  void choose(const LevelChoice& level);

  const Mesh& mesh() const { return player_.mesh(); }
  const StreamHeader& header() const { return player_.header(); }
  std::uint32_t first_frame_number() const { return player_.header().first_frame_number; }

  // The frames that are whole, and those that the stream promises.
  std::uint32_t available_frames() const { return player_.available_frames(); }
  std::optional<std::uint32_t> frame_count() const { return player_.frame_count(); }

  // Makes the level of detail of a frame, counted from 0. Precondition: frame < available_frames().
  // With hysteresis it depends on the frame gone to before. With a blend it is as when playing to it: the frames since
  // the one gone to before, or as many as a change takes, are gone through.
  Result<void> go_to(std::uint32_t frame);

  // Preconditions of all that follow: go_to() succeeded.

  const FrameState& state() const { return player_.state(); }
  // The input mesh as it was, with isolated vertices and degenerate triangles, at the finest level.
  const MeshBuffers& buffers() const { return buffers_; }

  // What the stream's errors say of the level's: the root of the mean squared distance over the surface, in percent of
  // the diagonal of the frame's bounding box. 0 at the finest level.
  double estimated_error() const;

  // Cut::seen_error(), where the level is chosen with a view.
  std::optional<double> seen_error() const;

 private:
  explicit StreamLevels(std::string name) : name_(std::move(name)) {}
  Error located(const Error& error) const;
  Result<void> show(std::uint32_t frame);

  std::string name_;
  std::string bytes_;
  Player player_;
  std::optional<Cut> cut_;
  std::optional<limber::View> view_;
  std::optional<Blend> blend_;   // where changes are blended
  std::uint32_t shown_ = kNone;  // the last frame cut; kNone before the first
  ExtractScratch scratch_;
  MeshBuffers buffers_;
};

}  // namespace limber::eval
