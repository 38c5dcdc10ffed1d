// SPDX-License-Identifier: Apache-2.0
// Lines along silhouettes and borders. A wireframe that triangles draw on themselves shows only the inner half of these
// lines; strokes add the half that lies over whatever is behind.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "eval/raster.h"

namespace limber::eval {

using Segment = std::array<Index, 2>;

// Edges that do not separate two triangles seen from the same side, lower vertex first, in rising order, each once.
// Triangles without a picture do not count.
std::vector<Segment> silhouette_edges(std::span<const Triangle> triangles, std::span<const ScreenPoint> points);

// Share of ink in [0, 1] at `distance` pixels from the middle of a line; the edge of the line is soft over less than a
// pixel.
float ink_share(double distance, double line_width);

// For each sample of the tile, the largest ink share of the segments that are not behind what the sample shows.
// ink: as many as the tile has samples.
void draw_strokes(std::span<const Segment> segments, std::span<const ScreenPoint> points, std::span<const Index> items,
                  const SamplePattern& pattern, double line_width, const TileSamples& tile, std::span<float> ink);

}  // namespace limber::eval
