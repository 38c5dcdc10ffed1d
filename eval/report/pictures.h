// SPDX-License-Identifier: Apache-2.0
// The pictures of the report: whole frames, and close-ups of the worst places.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "eval/picture.h"
#include "eval/report/kept_frames.h"
#include "eval/report/parts.h"
#include "eval/report/worst_places.h"
#include "limber/base/mesh.h"
#include "limber/base/result.h"

namespace limber::eval {

// The same view of the original and of what every method makes of it.
struct PictureRow {
  std::size_t frame = 0;  // counted from 0
  int width = 0, height = 0;
  std::vector<std::string> pictures{};  // [1 + methods]: PNG in base64; the original first
  std::vector<std::byte> sheet{};       // where asked for: a PNG file of all of them, with labels
};

struct CloseUp {
  std::size_t method = 0;  // that is worst here
  WorstPlace place{};
  PictureRow row{};
};

struct PictureSet {
  std::vector<PictureRow> gallery{};
  std::vector<PictureRow> parts{};  // [parts], of the last frame
  std::vector<CloseUp> close_ups{};
  double error_range = 0;  // where the colours of all pictures end, percent of the diagonal
};

struct PictureSetOptions {
  View view{};
  UpAxis up = UpAxis::kY;
  double error_range = 1;
  const Parts* parts = nullptr;             // nothing: none are shown
  std::vector<std::string> sheet_labels{};  // [1 + methods], or empty: no sheets are made
};

// The methods whose worst places are shown: of all but the first, in the order of what they lose there, the worst, the
// best and others evenly between; a place that one of them shares with another is shown once. Of one method: its own.
std::vector<std::size_t> chosen_places(const WorstPlaces& places, std::size_t method_count, std::size_t count);

// `done(pictures, of all)` is called after each; false: stop, error kCancelled.
Result<PictureSet> take_report_pictures(const Mesh& mesh, const KeptFrames& kept, const WorstPlaces& places,
                                        std::span<const std::size_t> shown, const PictureSetOptions& options,
                                        const std::function<bool(std::size_t, std::size_t)>& done);

}  // namespace limber::eval
