// SPDX-License-Identifier: Apache-2.0
// What a sound stream promises, tested without relying on what wrote it. The checks, by the names that are reported:
//
//   checksum           every chunk of the file has the checksum that it says
//   whole              the stream goes on to its index and its end mark, with all its frames
//   decodes            every frame obeys the rules of the format
//   positions-finite   positions are finite, errors finite and not negative
//   swaps-lead-here    a frame's swaps lead from the frame before to its hierarchy
//   (hierarchy.h)      the invariants of the hierarchy, on every level
//   seek-equals-play   seeking a frame gives what playing up to it gives
//   matches-clip       with --against: the same mesh, as many frames
//   within-tolerance   with --against: no position is further from that of the clip than the stream promises
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "limber/hierarchy/validate.h"
#include "limber/stream/chunk.h"
#include "limber/stream/four_k_decoder.h"
#include "limber/view/player.h"
#include "tool/clip_argument.h"
#include "tool/four_face.h"
#include "tool/frames_argument.h"
#include "tool/progress.h"
#include "tool/ranges.h"
#include "tool/stream_file.h"
#include "tool/verb.h"

namespace limber::tool {
namespace {

struct Arguments {
  std::string file;
  ClipArgument against;
  std::uint32_t seek_count = 16;
  bool seek_all = false;
};

// What is wrong: the check that failed, and where and how.
struct Finding {
  std::string check;
  std::optional<std::uint32_t> frame;  // as the source numbers it
  std::string what;
};

// All of a stream's checks stop at the first finding.
class StreamCheck {
 public:
  StreamCheck(const StreamFile& file, ClipReader* against, Console& console)
      : file_(file), against_(against), console_(console) {}

  // kTruncated and others: not even header and mesh can be read; kCancelled.
  Result<std::optional<Finding>> run(std::uint32_t seek_count, bool seek_all);

  std::uint32_t frame_count() const { return frame_count_; }
  std::uint32_t sought_count() const { return sought_count_; }
  double greatest_distance() const { return greatest_distance_; }

 private:
  std::optional<Finding> check_chunks() const;
  std::optional<Finding> check_whole() const;
  std::optional<Finding> check_clip() const;
  std::optional<Finding> check_frame(const FrameState& state, bool is_key, Validator& validator);
  Result<std::optional<Finding>> check_distances(const FrameState& state);
  Result<std::optional<Finding>> play_all();
  Result<std::optional<Finding>> seek(std::uint32_t count);
  std::uint32_t number(std::uint32_t frame) const { return player_.header().first_frame_number + frame; }

  const StreamFile& file_;
  ClipReader* against_;
  Console& console_;
  Player player_;
  std::uint32_t frame_count_ = 0;
  std::uint32_t sought_count_ = 0;
  double greatest_distance_ = 0;
  std::vector<Index> parents_before_;        // [node_count]
  std::vector<Vec3f> expected_;              // [vertex_count], of the clip
  std::vector<std::uint64_t> fingerprints_;  // [frame_count_]
};

// Of everything that a frame is, bit by bit (FNV-1a, by words).
std::uint64_t fingerprint(const FrameState& state) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&hash](std::uint32_t word) { hash = (hash ^ word) * 1099511628211u; };
  for (const Index parent : state.hierarchy.parent) add(parent);
  for (const Vec3f& p : state.positions)
    for (const float x : {p.x, p.y, p.z}) add(std::bit_cast<std::uint32_t>(x));
  for (const float error : state.errors) add(std::bit_cast<std::uint32_t>(error));
  return hash;
}

std::optional<Finding> StreamCheck::check_chunks() const {
  const std::span<const std::byte> bytes = file_.bytes();
  std::uint64_t offset = kPreambleSize;
  while (offset + kEndMarkSize < bytes.size()) {
    const Result<ChunkHeader> header = read_chunk_header(bytes, offset);
    if (!header && header.error().code == ErrorCode::kTruncated) break;  // check_whole() says so
    if (!header) return Finding{"checksum", {}, header.error().line()};
    if (!chunk_is_whole(bytes, offset, *header)) break;
    if (auto payload = read_payload(bytes, offset, *header); !payload)
      return Finding{"checksum", {}, payload.error().line()};
    offset += kChunkHeaderSize + header->length;
    if (header->kind == kIndexChunk) break;
  }
  return std::nullopt;
}

std::optional<Finding> StreamCheck::check_whole() const {
  const std::span<const std::byte> bytes = file_.bytes();
  const bool has_end =
      bytes.size() >= kEndMarkSize && std::equal(kEndMagic.begin(), kEndMagic.end(), bytes.end() - kEndMagic.size(),
                                                 [](std::uint8_t a, std::byte b) { return std::byte{a} == b; });
  if (has_end && player_.frame_count() == frame_count_) return std::nullopt;
  const auto all = player_.frame_count();
  return Finding{"whole",
                 {},
                 fmt::format("{}{}; build or copy it again", has_end ? "" : "the file ends early: ",
                             all ? fmt::format("{} of {} frames are there", frame_count_, *all)
                                 : fmt::format("{} frames are there", frame_count_))};
}

std::optional<Finding> StreamCheck::check_clip() const {
  if (!against_) return std::nullopt;
  if (against_->mesh() != player_.mesh()) return Finding{"matches-clip", {}, "the clip has another mesh"};
  if (against_->frame_count() && *against_->frame_count() != frame_count_) {
    return Finding{"matches-clip",
                   {},
                   fmt::format("the clip has {} frames, the stream {}", *against_->frame_count(), frame_count_)};
  }
  return std::nullopt;
}

std::optional<Finding> StreamCheck::check_frame(const FrameState& state, bool is_key, Validator& validator) {
  const std::uint32_t at = number(state.frame);
  for (std::size_t node = 0; node < state.positions.size(); ++node) {
    if (!is_finite(state.positions[node]) || !std::isfinite(state.errors[node]) || state.errors[node] < 0)
      return Finding{"positions-finite", at, fmt::format("is broken at node {}", node)};
  }
  if (!is_key) {
    for (const Swap& swap : state.swaps) parents_before_[swap.node] = swap.parent;
    if (parents_before_ != state.hierarchy.parent)
      return Finding{"swaps-lead-here", at, "the swaps lead to another hierarchy"};
  }
  parents_before_ = state.hierarchy.parent;
  if (const std::optional<Violation> violation = validator(state.hierarchy))
    return Finding{std::string(violation->invariant), at, violation->line()};
  return std::nullopt;
}

Result<std::optional<Finding>> StreamCheck::check_distances(const FrameState& state) {
  if (!against_) return std::optional<Finding>();
  const Result<bool> more = against_->read(expected_);
  if (!more) return more.error();
  if (!*more) return std::optional(Finding{"matches-clip", number(state.frame), "the clip ends before this frame"});
  const double tolerance = player_.header().tolerance;
  for (std::size_t v = 0; v < expected_.size(); ++v) {
    const double distance = length(Vec3d(state.positions[v]) - Vec3d(expected_[v]));
    greatest_distance_ = std::max(greatest_distance_, distance);
    if (distance <= tolerance) continue;
    return std::optional(Finding{
        "within-tolerance", number(state.frame),
        fmt::format("vertex {} is {:.6g} away from the clip's, where {:.6g} is promised", v, distance, tolerance)});
  }
  return std::optional<Finding>();
}

Result<std::optional<Finding>> StreamCheck::play_all() {
  Validator validator(player_.mesh(), player_.header().manifold_kept ? Topology::kPreserve : Topology::kFree);
  Decoder decoder;
  if (Result<void> opened = decoder.open(file_.bytes()); !opened) return in_file(file_.name(), opened.error());
  FrameState state;
  decoder.prepare(state);
  Progress progress(console_, "checking", frame_count_);
  expected_.resize(player_.mesh().vertex_count);
  for (std::uint32_t frame = 0; frame < frame_count_; ++frame) {
    if (Result<void> decoded = decoder.decode(frame, state); !decoded)
      return std::optional(Finding{"decodes", number(frame), decoded.error().line()});
    if (auto found = check_frame(state, decoder.is_key(frame), validator)) return found;
    auto found = check_distances(state);
    if (!found || *found) return found;
    fingerprints_.push_back(fingerprint(state));
    if (!progress.update(frame + 1)) return Error{ErrorCode::kCancelled, "", "interrupted"};
  }
  if (against_) {
    const Result<bool> more = against_->read(expected_);
    if (!more) return more.error();
    if (*more) return std::optional(Finding{"matches-clip", {}, "the clip goes on after the stream's last frame"});
  }
  return std::optional<Finding>();
}

// Backwards, so that every seek starts at a key.
Result<std::optional<Finding>> StreamCheck::seek(std::uint32_t count) {
  Progress progress(console_, "seeking", count);
  for (std::uint32_t i = count; i-- > 0;) {
    const auto frame = static_cast<std::uint32_t>(std::uint64_t{i} * frame_count_ / count);
    const Result<void> sought = player_.seek(frame);
    if (!sought || fingerprint(player_.state()) != fingerprints_[frame]) {
      return std::optional(Finding{"seek-equals-play", number(frame),
                                   sought ? "seeking gives another frame than playing" : sought.error().line()});
    }
    ++sought_count_;
    if (!progress.update(count - i)) return Error{ErrorCode::kCancelled, "", "interrupted"};
  }
  return std::optional<Finding>();
}

Result<std::optional<Finding>> StreamCheck::run(std::uint32_t seek_count, bool seek_all) {
  Decoder decoder;
  if (Result<void> opened = decoder.open(file_.bytes()); !opened) return in_file(file_.name(), opened.error());
  frame_count_ = decoder.available_frames();
  if (auto found = check_chunks()) return found;
  if (Result<void> opened = player_.open(file_.bytes()); !opened)
    return std::optional(Finding{"decodes", decoder.header().first_frame_number, opened.error().line()});
  if (auto found = check_whole()) return found;
  if (auto found = check_clip()) return found;
  auto found = play_all();
  if (!found || *found) return found;
  // Away from frame 0, so that the first seek is one, too.
  if (frame_count_ > 1)
    if (Result<void> gone = player_.seek(frame_count_ - 1); !gone) return in_file(file_.name(), gone.error());
  return seek(seek_all ? frame_count_ : std::min(seek_count, frame_count_));
}

Result<Exit> report(const StreamFile& file, const StreamCheck& check, const std::optional<Finding>& finding,
                    bool has_clip, Console& console) {
  Json json = {{"file", file.name()}, {"passed", !finding}, {"frames", check.frame_count()}};
  json["sought"] = check.sought_count();
  if (has_clip) json["greatest_distance"] = check.greatest_distance();
  if (finding) {
    json["failed"] = finding->check;
    json["frame"] = finding->frame ? Json(*finding->frame) : Json(nullptr);
    json["what"] = finding->what;
    console.print("{}: {}{}: {}\n", one_line(file.name()),
                  finding->frame ? fmt::format("frame {}: ", *finding->frame) : "", finding->check, finding->what);
  } else {
    console.print("{}: sound: {} frames, every invariant on every level; {} frames sought{}\n", one_line(file.name()),
                  check.frame_count(), check.sought_count(),
                  has_clip ? fmt::format("; at most {:.6g} from the clip", check.greatest_distance()) : "");
  }
  console.report("limber.check/1", json);
  return finding ? Exit::kCheckFailed : Exit::kDone;
}

Result<Exit> check(const Arguments& arguments, Console& console) {
  if (arguments.against.specification.empty() &&
      (is_part(arguments.against.options) || !arguments.against.options.mesh.empty()))
    throw UsageError("--mesh, --frames, --first and --last are those of the clip: they need --against");
  const Result<StreamFile> file = StreamFile::open(arguments.file);
  if (!file) return file.error();
  if (is_four_face_file(file->bytes())) {
    if (!arguments.against.specification.empty())
      throw UsageError("--against is for streams; a four-face file has numbers of its own for the vertices");
    return check_four_face(*file, console);
  }
  std::unique_ptr<ClipReader> clip;
  if (!arguments.against.specification.empty()) {
    auto opened = open_any_clip(arguments.against);
    if (!opened) return opened.error();
    clip = std::move(*opened);
  }
  StreamCheck stream_check(*file, clip.get(), console);
  const auto finding = stream_check.run(arguments.seek_count, arguments.seek_all);
  if (!finding) return finding.error();
  return report(*file, stream_check, *finding, clip != nullptr, console);
}

}  // namespace

Action declare_check(CLI::App& app) {
  const auto arguments = std::make_shared<Arguments>();
  app.add_option("FILE", arguments->file, "a stream; - for standard input")->required();
  CLI::Option* const seeks = app.add_option("--seeks", arguments->seek_count, "seek so many frames, spread evenly")
                                 ->check(in_range(0, 4294967295.0))
                                 ->type_name("N")
                                 ->capture_default_str();
  app.add_flag("--all", arguments->seek_all, "seek every frame; not with --seeks")->excludes(seeks);
  declare_clip(app, arguments->against, "--against");
  app.get_option("--against")->required(false)->type_name("CLIP");
  return [arguments](Console& console) { return check(*arguments, console); };
}

}  // namespace limber::tool
