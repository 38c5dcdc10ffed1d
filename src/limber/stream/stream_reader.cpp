// SPDX-License-Identifier: Apache-2.0
#include "limber/stream/stream_reader.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "limber/clip/frame_files.h"
#include "limber/clip/frame_range.h"
#include "limber/stream/decoder.h"

namespace limber {
namespace {

Error in_file(const std::string& name, const Error& error) {
  return {error.code, error.where.empty() ? name : name + ": " + error.where, error.what};
}

class StreamReader final : public ClipReader {
 public:
  StreamReader(Decoder decoder, std::string name) : decoder_(std::move(decoder)), name_(std::move(name)) {
    decoder_.prepare(state_);
    end_ = decoder_.frame_count().value_or(decoder_.available_frames());
    has_end_ = decoder_.frame_count().has_value();
  }

  void limit(std::uint32_t begin, std::uint32_t end, bool has_end) {
    next_ = begin_ = begin;
    end_ = end;
    has_end_ = has_end;
  }

  const Mesh& mesh() const override { return decoder_.mesh(); }
  std::optional<std::uint32_t> frame_count() const override {
    return has_end_ ? std::optional(end_ - begin_) : std::nullopt;
  }
  double frames_per_second() const override { return decoder_.header().frames_per_second; }
  std::uint32_t first_frame_number() const override { return decoder_.header().first_frame_number + begin_; }

  Result<bool> read(std::span<Vec3f> positions) override {
    assert(positions.size() == mesh().vertex_count);
    if (next_ >= decoder_.available_frames() && (next_ < end_ || !has_end_)) {
      return Error{ErrorCode::kTruncated, name_,
                   "ends after " + std::to_string(decoder_.available_frames()) +
                       " whole frames, before the end of the stream; copy it again, or choose frames with --last"};
    }
    if (next_ == end_) return false;
    const bool onwards = state_.frame != kNone && state_.frame + 1 == next_;
    for (std::uint32_t frame = onwards ? next_ : decoder_.key_at_or_before(next_); frame <= next_; ++frame)
      if (Result<void> decoded = decoder_.decode(frame, state_); !decoded) return in_file(name_, decoded.error());
    ++next_;
    std::copy_n(state_.positions.begin(), positions.size(), positions.begin());
    return true;
  }

  Result<void> rewind() override {
    next_ = begin_;
    state_.frame = kNone;
    return {};
  }

 private:
  Decoder decoder_;
  std::string name_;
  FrameState state_;
  std::uint32_t begin_ = 0, end_ = 0, next_ = 0;  // counted from the stream's frame 0
  bool has_end_ = false;                          // is end_ where the clip ends, not only where the bytes end?
};

}  // namespace

Result<std::unique_ptr<ClipReader>> open_stream_clip(std::span<const std::byte> bytes, const ClipOptions& options,
                                                     const std::string& name) {
  Decoder decoder;
  if (Result<void> opened = decoder.open(bytes); !opened) return in_file(name, opened.error());
  const std::uint32_t first = decoder.header().first_frame_number;
  const std::uint32_t count = decoder.frame_count().value_or(decoder.available_frames());
  auto reader = std::make_unique<StreamReader>(std::move(decoder), name);
  if (options.first || options.last) {
    if (count == 0) return Error{ErrorCode::kTruncated, name, "ends before its first frame; copy it again"};
    const Result<void> checked = check_range(options, first, std::uint64_t{first} + count - 1, name);
    if (!checked) return checked.error();
    const bool has_end = options.last || reader->frame_count().has_value();
    reader->limit(options.first.value_or(first) - first, options.last ? *options.last - first + 1 : count, has_end);
  }
  return every_nth(std::move(reader), options.step);
}

}  // namespace limber
