// SPDX-License-Identifier: Apache-2.0
// How the clusters and frames of a four-face file are coded, for both directions (docs/format.md, "Four-face files").
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "limber/stream/error_coding.h"
#include "limber/stream/four_k_growth.h"
#include "limber/stream/quantizer.h"
#include "limber/stream/range_coder.h"

namespace limber {

// What a coordinate is expected to be, and how far the coordinates lie apart that say so: 0 to 32, the bits of it.
struct LatticeGuess {
  Lattice expected{};
  std::array<unsigned, 3> spread{};
};

// Of a vertex between the parents that it came between: their mean, rounded down. `at`: by vertex.
LatticeGuess guess_between(std::span<const Index> parents, std::span<const Lattice> at);

// Of a vertex in another frame: `at[v]`, and the mean of how its parents have moved from `at` to `now`.
LatticeGuess guess_moved(Index v, std::span<const Index> parents, std::span<const Lattice> at,
                         std::span<const Lattice> now);

struct LatticeModels {
  std::array<std::array<DifferenceModel, 33>, 3> axes;  // by spread

  template <class Coder>
  Lattice code(Coder& coder, const LatticeGuess& guess, const Lattice& actual = {}) {
    Lattice result;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto expected = static_cast<std::uint32_t>(guess.expected[i]);
      std::int32_t difference = 0;
      if constexpr (Coder::kEncodes)
        difference = static_cast<std::int32_t>(static_cast<std::uint32_t>(actual[i]) - expected);
      difference = axes[i][guess.spread[i]].code(coder, difference);
      result[i] = static_cast<std::int32_t>(expected + static_cast<std::uint32_t>(difference));
    }
    return result;
  }
};

// Of all operations in another frame, by the difference to those of the frame it builds on, `errors`, which become
// those of the frame. `actual(i)` gives the quantized error to write. False where the bytes are wrong.
template <class Coder, class Actual>
bool code_pose_errors(Coder& coder, std::span<std::int32_t> errors, Actual&& actual) {
  std::array<std::array<DifferenceModel, 3>, 2> models;  // by whether there was an error; the difference before
  std::size_t size_before = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const std::int32_t base = errors[i];
    std::int32_t difference = 0;
    if constexpr (Coder::kEncodes) difference = actual(i) - base;
    difference = models[base != 0][size_before].code(coder, difference);
    if (difference < -base || difference > kLargestError - base) return false;
    errors[i] = base + difference;
    size_before = difference == 0 ? 0 : difference >= -1 && difference <= 1 ? 1 : 2;
  }
  return true;
}

// A vertex that is put back, by a cluster: its removal reversed.
struct FourKRemoval {
  Refinement kind = Refinement::kFour;
  Index kept = 0;   // u, by its number in the file
  Index place = 0;  // in the star of u
  Lattice position{};
  Index number = 0;        // of the input
  std::int32_t error = 0;  // quantized
  std::uint32_t swap_count = 0;
};

// A swap that is reversed after it.
struct FourKSwap {
  Index place = 0;         // in the star of the vertex
  std::int32_t error = 0;  // quantized, at most that of the removal
};

// Codes clusters, one after the other; what has come before is in `growth`, which grows with them. The functions give
// false where the bytes are wrong.
template <class Coder>
class FourKCoding {
 public:
  struct Models {
    SymbolModel<2> kind;
    LatticeModels position;
    DifferenceModel number, error;
    NumberModel swap_count, swap_error;
    std::int32_t error_before = 0;
  };

  // input_count: numbers are below it.
  FourKCoding(Coder& coder, Models& models, FourKGrowth& growth, std::vector<Lattice>& positions,
              std::vector<Index>& numbers, Index input_count)
      : coder_(coder),
        models_(models),
        growth_(growth),
        positions_(positions),
        numbers_(numbers),
        input_count_(input_count) {}

  // Adds a vertex, its position and number, and reverses its removal.
  bool removal(FourKRemoval& r) {
    const Index before = growth_.vertex_count();
    if (before == 0) return false;
    r.kind = static_cast<Refinement>(models_.kind.code(coder_, static_cast<std::uint32_t>(r.kind)));
    r.kept = below(before, r.kept);
    if (r.kept >= before || !place(r.kept, r.place)) return false;
    const Index v = growth_.add_vertex();
    if (!growth_.refine(r.kind, r.kept, r.place, v)) return false;
    r.position = models_.position.code(coder_, guess_between(growth_.parents(v), positions_), r.position);
    positions_.push_back(r.position);
    if (!number(numbers_[r.kept], r.number)) return false;
    numbers_.push_back(r.number);
    r.error = models_.error_before + models_.error.code(coder_, r.error - models_.error_before);
    if (r.error < 0 || r.error > kLargestError) return false;
    models_.error_before = r.error;
    r.swap_count = models_.swap_count.code(coder_, r.swap_count);
    return true;
  }

  // The next swap of the last vertex, whose removal has this error.
  bool swap(std::int32_t removal_error, FourKSwap& s) {
    const Index v = growth_.vertex_count() - 1;
    if (!place(v, s.place) || !growth_.refine(Refinement::kSwap, v, s.place, v)) return false;
    const std::uint32_t below_removal =
        models_.swap_error.code(coder_, static_cast<std::uint32_t>(removal_error - s.error));
    if (below_removal > static_cast<std::uint32_t>(removal_error)) return false;
    s.error = removal_error - static_cast<std::int32_t>(below_removal);
    return true;
  }

  // The next vertex of the coarsest mesh.
  bool coarsest(Lattice& position, Index& number_of_it) {
    LatticeGuess guess{.spread = {32, 32, 32}};
    if (!positions_.empty()) guess.expected = positions_.back();
    position = models_.position.code(coder_, guess, position);
    if (!number(numbers_.empty() ? 0 : numbers_.back(), number_of_it)) return false;
    positions_.push_back(position);
    numbers_.push_back(number_of_it);
    return true;
  }

 private:
  Index below(Index count, Index value) {
    return code_plain(coder_, static_cast<unsigned>(std::bit_width(count - 1)), value);
  }
  bool place(Index u, Index& at) {
    const auto count = static_cast<Index>(growth_.star(u).size());
    if (count == 0) return false;
    at = below(count, at);
    return at < count;
  }
  bool number(Index beside, Index& value) {
    const std::int32_t difference = models_.number.code(coder_, static_cast<std::int32_t>(value - beside));
    value = beside + static_cast<Index>(difference);
    return value < input_count_;
  }

  Coder& coder_;
  Models& models_;
  FourKGrowth& growth_;
  std::vector<Lattice>& positions_;
  std::vector<Index>& numbers_;
  Index input_count_;
};

// The positions of another frame: of vertices in the file's order, from those of the frame that it builds on, `from`.
// actual(v): what to write.
template <class Coder, class Parents, class Actual>
void code_pose(Coder& coder, LatticeModels& models, const Parents& parents, std::span<const Lattice> from,
               std::span<Lattice> now, const Actual& actual) {
  for (Index v = 0; v < now.size(); ++v) {
    const Lattice wanted = Coder::kEncodes ? actual(v) : Lattice{};
    now[v] = models.code(coder, guess_moved(v, parents(v), from, now), wanted);
  }
}

}  // namespace limber
