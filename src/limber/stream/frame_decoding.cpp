// SPDX-License-Identifier: Apache-2.0
// What a player spends most of a frame on: for browsers it is compiled for speed (scripts/build-wasm).
#include "limber/stream/frame_decoding.h"

#include <algorithm>

#include "limber/stream/bytes.h"

namespace limber {
namespace {

// Codes nothing: what a coder of both directions calls for a value to write.
constexpr auto kNoLattice = [](auto...) { return Lattice{}; };

// Precondition: the section has kFactorsSize bytes.
constexpr std::size_t kFactorsSize = 6;
MotionFactors read_factors(std::span<const std::byte> section) {
  const auto fixed_point = [&](std::size_t at) {
    return static_cast<std::int16_t>(load_little_endian<std::uint16_t>(&section[at]));
  };
  return {fixed_point(0), fixed_point(2), fixed_point(4)};
}

bool in_range(std::int16_t factor) { return factor >= -kMostFactor && factor <= kMostFactor; }

const char* decode_finest(CodingState& coding, const Quantizer& quantizer, bool key, std::span<const std::byte> section,
                          FrameState& state) {
  MotionFactors factors;
  if (!key) {
    if (section.size() < kFactorsSize) return "the section of the finest positions is too short";
    factors = read_factors(section);
    if (!in_range(factors.past) || !in_range(factors.here) || !in_range(factors.before))
      return "a factor of the motion is outside its range";
    section = section.subspan(kFactorsSize);
  }
  ResidualReader reader(section, coding.finest_statistics);
  if (key) {
    coding.finest.code_key(reader, kNoLattice);
  } else {
    coding.finest.code_step(factors, reader, kNoLattice);
  }
  if (!reader.consistent()) return "the finest positions are not what an encoder writes";
  coding.finest_statistics.update();
  const auto place = coding.finest.positions();
  for (Index i = 0; i < place.size(); ++i) state.positions[coding.traversal.order[i]] = quantizer.position(place[i]);
  return nullptr;
}

const char* decode_coarser(CodingState& coding, const Quantizer& quantizer, bool key,
                           std::span<const std::byte> section, FrameState& state) {
  const auto positions = coding.coarser.positions();
  if (positions.empty()) return nullptr;
  ResidualReader reader(section, coding.coarser_statistics);
  coding.coarser.code(key, coding.clusters.parents(), coding.traversal, coding.finest, reader, kNoLattice);
  if (!reader.consistent()) return "the coarser positions are not what an encoder writes";
  coding.coarser_statistics.update();
  const auto to = std::span(state.positions).last(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) to[i] = quantizer.position(positions[i]);
  return nullptr;
}

const char* decode_errors(CodingState& coding, bool key, std::span<const std::byte> section, FrameState& state) {
  ErrorState& errors = coding.errors;
  if (errors.nodes.empty()) return nullptr;
  ResidualStatistics& statistics = key ? errors.key_statistics : errors.step_statistics;
  ResidualReader reader(section, statistics);
  if (!code_errors(reader, errors, key, coding.clusters.changed(), [](std::size_t) { return 0; }))
    return "an error is outside its range";
  if (!reader.consistent()) return "the errors are not what an encoder writes";
  statistics.update();
  const auto to = std::span(state.errors).last(errors.nodes.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = error_value(errors.nodes[i].error);
  return nullptr;
}

}  // namespace

bool decode_hierarchy_section(CodingState& coding, bool key, std::span<const std::byte> section, FrameState& state) {
  RangeDecoder coder(section);
  Clusters& clusters = coding.clusters;
  state.swaps.clear();
  if (key) {
    coding.reset_models();
    if (!code_key_hierarchy(coder, coding.hierarchy_models, clusters, coding.traversal, coding.order)) return false;
    std::copy(clusters.parents().begin(), clusters.parents().end(), state.hierarchy.parent.begin());
    return true;
  }
  clusters.forget_changes();
  if (!code_swaps(coder, coding.hierarchy_models, clusters, state.swaps)) return false;
  for (const Swap& swap : state.swaps) apply(state.hierarchy, swap);
  return true;
}

const char* decode_position_sections(CodingState& coding, const Quantizer& quantizer, bool key,
                                     const PositionSections& sections, FrameState& state) {
  const char* broken = decode_finest(coding, quantizer, key, sections.finest, state);
  if (broken == nullptr) broken = decode_coarser(coding, quantizer, key, sections.coarser, state);
  if (broken == nullptr && quantizer.lossless() &&
      !std::all_of(state.positions.begin(), state.positions.end(), is_finite<float>))
    broken = "a position is not finite";
  if (broken == nullptr) broken = decode_errors(coding, key, sections.errors, state);
  return broken;
}

}  // namespace limber
