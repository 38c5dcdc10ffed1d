// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/frame_range.h"

#include <cassert>
#include <utility>
#include <vector>

#include "limber/clip/frame_files.h"

namespace limber {
namespace {

class FrameRange final : public ClipReader {
 public:
  FrameRange(std::unique_ptr<ClipReader> reader, std::uint32_t begin, std::uint32_t end)
      : reader_(std::move(reader)), begin_(begin), end_(end) {}

  const Mesh& mesh() const override { return reader_->mesh(); }
  std::optional<std::uint32_t> frame_count() const override { return end_ - begin_; }
  double frames_per_second() const override { return reader_->frames_per_second(); }
  std::uint32_t first_frame_number() const override { return reader_->first_frame_number() + begin_; }

  Result<bool> read(std::span<Vec3f> positions) override {
    if (next_ == end_) return false;
    while (next_ < begin_) {
      const Result<bool> passed_over = read_next(positions);
      if (!passed_over || !*passed_over) return passed_over;
    }
    return read_next(positions);
  }

  Result<void> rewind() override {
    next_ = 0;
    return reader_->rewind();
  }

 private:
  Result<bool> read_next(std::span<Vec3f> positions) {
    Result<bool> more = reader_->read(positions);
    if (more && *more) ++next_;
    return more;
  }

  std::unique_ptr<ClipReader> reader_;
  std::uint32_t begin_, end_;  // counted from the reader's first frame
  std::uint32_t next_ = 0;
};

class EveryNth final : public ClipReader {
 public:
  EveryNth(std::unique_ptr<ClipReader> reader, std::uint32_t step) : reader_(std::move(reader)), step_(step) {}

  const Mesh& mesh() const override { return reader_->mesh(); }
  std::optional<std::uint32_t> frame_count() const override {
    const std::optional<std::uint32_t> count = reader_->frame_count();
    if (!count) return std::nullopt;
    return *count / step_ + (*count % step_ != 0);
  }
  double frames_per_second() const override { return reader_->frames_per_second() / step_; }
  std::uint32_t first_frame_number() const override { return reader_->first_frame_number(); }

  Result<bool> read(std::span<Vec3f> positions) override {
    if (!is_first_) {
      skipped_.resize(positions.size());
      for (std::uint32_t i = 1; i < step_; ++i) {
        const Result<bool> more = reader_->read(skipped_);
        if (!more || !*more) return more;
      }
    }
    is_first_ = false;
    return reader_->read(positions);
  }

  Result<void> rewind() override {
    is_first_ = true;
    return reader_->rewind();
  }

 private:
  std::unique_ptr<ClipReader> reader_;
  std::uint32_t step_;
  bool is_first_ = true;
  std::vector<Vec3f> skipped_;
};

}  // namespace

Result<std::unique_ptr<ClipReader>> limit_frames(std::unique_ptr<ClipReader> reader, const ClipOptions& options,
                                                 const std::string& where) {
  assert(reader->frame_count());
  if (!options.first && !options.last) return reader;
  const std::uint32_t first = reader->first_frame_number(), count = *reader->frame_count();
  const Result<void> checked = check_range(options, first, std::uint64_t{first} + count - 1, where);
  if (!checked) return checked.error();
  const std::uint32_t begin = options.first.value_or(first) - first;
  const std::uint32_t end = options.last ? *options.last - first + 1 : count;
  return std::unique_ptr<ClipReader>(std::make_unique<FrameRange>(std::move(reader), begin, end));
}

std::unique_ptr<ClipReader> every_nth(std::unique_ptr<ClipReader> reader, std::uint32_t step) {
  assert(step >= 1);
  if (step == 1) return reader;
  return std::make_unique<EveryNth>(std::move(reader), step);
}

}  // namespace limber
