// SPDX-License-Identifier: Apache-2.0
// What it takes to store what a method made (Kircher & Garland 2005, section 6).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/comparison.h"
#include "eval/report/svg.h"
#include "limber/stream/build_stream.h"

namespace limber::eval {

struct StorageRow {
  std::string what{};
  std::optional<MethodMark> mark{};
  std::string how{};                     // what is stored, in words
  std::optional<double> connectivity{};  // bytes per frame, mean
  std::optional<double> positions{};     // likewise
  double total = 0;                      // bytes of the clip
};

// The clip as it is, each contender as plain numbers (32-bit indices, once where the triangles never change and per
// frame where they do; three floats per vertex and frame), and the stream of the clip where there is one, with the
// uncompressed records of the paper's own table.
std::vector<StorageRow> storage_rows(const Mesh& mesh, const Comparison& comparison, const BuildReport* stream);

}  // namespace limber::eval
