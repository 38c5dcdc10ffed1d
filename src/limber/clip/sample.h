// SPDX-License-Identifier: Apache-2.0
// Generated clips, of any size and length, the same bytes on every platform. They take the place of research clips
// that may not be passed on: detailed and strongly non-rigid.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "limber/clip/clip.h"

namespace limber {

struct SampleInfo {
  std::string_view name;         // the NAME of `sample:NAME`
  std::string_view description;  // one line
};

// All samples, in the order in which a help text lists them.
std::span<const SampleInfo> samples();

// Opens `sample:NAME`, or with one or both options, in any order, `sample:NAME?vertices=20000&frames=60`: 100 to
// 5,000,000 vertices (10,000 where not stated) and 1 to 100,000 frames (60). The clip has exactly so many.
// A frame is computed from its number alone, so reading needs no memory beyond that of one frame.
Result<std::unique_ptr<ClipReader>> open_sample(std::string_view specification);

}  // namespace limber
