// SPDX-License-Identifier: Apache-2.0
// The checks, by the names that are reported:
//
//   decodes            every chunk has its checksum and obeys the rules of the format
//   whole              all parts and frames are there, and the end mark
//   (validate.cpp)     the invariants of the 4-K mesh: of every part, and with the errors of every frame
//   parts-join         the coarsest triangles of the tiles are the finest of the first part, and errors do not fall
//                      from the one to the other
//   seek-equals-play   going to a frame from elsewhere gives what going through all of them gives
#include <algorithm>
#include <bit>
#include <optional>
#include <vector>

#include "limber/stream/four_k_clip.h"
#include "limber/stream/four_k_parts.h"
#include "tool/four_face.h"
#include "tool/progress.h"

namespace limber::tool {
namespace {

struct Finding {
  std::string check;
  std::string what;
};

std::uint64_t fingerprint(const FourKClip& clip) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&hash](float x) { hash = (hash ^ std::bit_cast<std::uint32_t>(x)) * 1099511628211u; };
  for (const Vec3f& p : clip.positions()) add(p.x), add(p.y), add(p.z);
  for (const float error : clip.mesh().error) add(error);
  return hash;
}

std::optional<Finding> check_mesh(const FourKMesh& mesh, std::span<const Vec3f> positions, const std::string& where) {
  if (const char* const broken = validate(mesh, positions)) return Finding{broken, where};
  return std::nullopt;
}

Result<std::optional<Finding>> check_frames(const StreamFile& file, Console& console) {
  FourKClip clip;
  if (const auto opened = clip.open(file.bytes()); !opened)
    return std::optional(Finding{"decodes", opened.error().line()});
  const std::uint32_t count = clip.decoder().frame_count();
  Progress progress(console, "checking", count);
  std::vector<std::uint64_t> fingerprints;
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    if (const auto gone = clip.go_to(frame); !gone) return std::optional(Finding{"decodes", gone.error().line()});
    if (auto found = check_mesh(clip.mesh(), clip.positions(), fmt::format("frame {}", frame))) return found;
    fingerprints.push_back(fingerprint(clip));
    if (!progress.update(frame + 1)) return interruption();
  }
  for (std::uint32_t i = 0; i < std::min(count, 16u); ++i) {
    const std::uint32_t frame = (count - 1) - i * std::max(count / 16, 1u) % count;
    const auto gone = clip.go_to(frame);
    if (!gone || fingerprint(clip) != fingerprints[frame])
      return std::optional(Finding{"seek-equals-play", fmt::format("frame {}", frame)});
  }
  return std::optional<Finding>();
}

Result<std::optional<Finding>> run(const StreamFile& file, const FourKDecoder& decoder, Console& console) {
  if (!decoder.is_whole()) return std::optional(Finding{"whole", "the file ends early; build or copy it again"});
  if (decoder.frame_count() > 1) return check_frames(file, console);
  Progress progress(console, "checking", decoder.part_count());
  for (std::uint32_t p = 0; p < decoder.part_count(); ++p) {
    const Result<FourKPart> part = decoder.read_part(p);
    if (!part) return std::optional(Finding{"decodes", part.error().line()});
    if (auto found = check_mesh(part->mesh, part->positions, fmt::format("part {}", p))) return found;
    if (!progress.update(p + 1)) return interruption();
  }
  const auto wrong = validate_joints(decoder);
  if (!wrong) return std::optional(Finding{"decodes", wrong.error().line()});
  if (*wrong) return std::optional(Finding{"parts-join", **wrong});
  return std::optional<Finding>();
}

}  // namespace

Result<Exit> check_four_face(const StreamFile& file, Console& console) {
  FourKDecoder decoder;
  if (const Result<void> opened = decoder.open(file.bytes()); !opened) return in_file(file.name(), opened.error());
  const auto found = run(file, decoder, console);
  if (!found) return found.error();
  Json json = {
      {"file", file.name()}, {"passed", !*found}, {"frames", decoder.frame_count()}, {"parts", decoder.part_count()}};
  if (*found) {
    json["failed"] = (*found)->check;
    json["what"] = (*found)->what;
    console.print("{}: {}: {}\n", one_line(file.name()), (*found)->check, (*found)->what);
  } else {
    console.print("{}: sound: {} frames, {} parts, every invariant of every operation\n", one_line(file.name()),
                  decoder.frame_count(), decoder.part_count());
  }
  console.report("limber.check_four_face/1", json);
  return *found ? Exit::kCheckFailed : Exit::kDone;
}

}  // namespace limber::tool
