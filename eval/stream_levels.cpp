// SPDX-License-Identifier: Apache-2.0
#include "eval/stream_levels.h"

#include <algorithm>
#include <cmath>

#include "eval/surface.h"
#include "limber/clip/input_file.h"

namespace limber::eval {

Error StreamLevels::located(const Error& error) const {
  return {error.code, error.where.empty() ? name_ : name_ + ": " + error.where, error.what};
}

Result<std::unique_ptr<StreamLevels>> StreamLevels::open(const std::filesystem::path& path) {
  std::unique_ptr<StreamLevels> levels(new StreamLevels(path.string()));
  if (const Result<void> read = read_file(path, levels->bytes_); !read) return read.error();
  const Result<void> opened = levels->player_.open(std::as_bytes(std::span(levels->bytes_)));
  if (!opened) return levels->located(opened.error());
  if (levels->available_frames() == 0) {
    return Error{ErrorCode::kTruncated, levels->name_, "ends before its first frame is whole"};
  }
  levels->choose({});
  return levels;
}

void StreamLevels::choose(const LevelChoice& level) {
  cut_.emplace(mesh(), state().hierarchy, level.cut.value_or(CutOptions{.by = CutBy::kLevel, .level = 0}));
  blend_.reset();
  shown_ = kNone;
  view_ = level.view;
  if (level.blend > 1) blend_.emplace(mesh(), state().hierarchy, BlendOptions{.frames = level.blend});
}

Result<void> StreamLevels::show(std::uint32_t frame) {
  if (const Result<void> found = player_.seek(frame); !found) return located(found.error());
  if (view_) {
    cut_->update(mesh(), state(), *view_);
  } else {
    cut_->update(mesh(), state());
  }
  if (blend_) blend_->update(state(), *cut_);
  shown_ = frame;
  return {};
}

Result<void> StreamLevels::go_to(std::uint32_t frame) {
  std::uint32_t first = frame;
  if (blend_) {
    first -= std::min(frame, blend_->options().frames);
    if (shown_ < frame) first = std::max(first, shown_ + 1);
  }
  for (std::uint32_t on_the_way = first; on_the_way <= frame; ++on_the_way) {
    if (const Result<void> shown = show(on_the_way); !shown) return shown;
  }
  if (blend_) {
    extract(mesh(), *blend_, scratch_, buffers_, {.whole_input = true});
  } else {
    extract(mesh(), state(), *cut_, scratch_, buffers_, {.whole_input = true});
  }
  return {};
}

double StreamLevels::estimated_error() const {
  const Surface surface{mesh().triangles, std::span(state().positions).first(mesh().vertex_count)};
  double doubled_area = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) doubled_area += length(area_vector(surface, t));
  double squared_error = 0;
  for (Index node = mesh().vertex_count; node < state().errors.size(); ++node) {
    const double error = state().errors[node];
    if (cut_->is_active(node)) squared_error += error * error;
  }
  const double diagonal = bounding_box(surface).diagonal();
  return doubled_area > 0 && diagonal > 0 ? 100 * std::sqrt(squared_error / (0.5 * doubled_area)) / diagonal : 0;
}

std::optional<double> StreamLevels::seen_error() const {
  if (!view_) return std::nullopt;
  return double{cut_->seen_error()};
}

}  // namespace limber::eval
