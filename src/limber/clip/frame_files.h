// SPDX-License-Identifier: Apache-2.0
// Which files are the frames of a clip, and in which order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "limber/base/result.h"
#include "limber/clip/clip.h"

namespace limber {

struct FrameFiles {
  std::vector<std::filesystem::path> paths;  // in the order of the frames; never empty
  std::uint32_t first_number = 0;            // of the first of them, as the files are numbered
};

// All three take mesh files (.obj .ply .off) of one extension, between options.first and options.last where given,
// without gaps in their numbers. The number of a file is the one that changes from file to file. Hidden files count
// only where they are asked for. Errors: kNotFound for no files, a missing number (it is named), and frames asked for
// beyond the first or last; kBadInput for two files of one number, and for several extensions (they are listed).

// Files of the NumberedName pattern that the file name is.
Result<FrameFiles> frames_of_pattern(const std::filesystem::path& pattern, const ClipOptions& options);

// Files whose names fit, `*` for any bytes and `?` for one. Where more than a number changes from name to name they
// are taken in natural order and numbered from 0.
Result<FrameFiles> frames_of_glob(const std::filesystem::path& glob, const ClipOptions& options);

// Numbered files of one extension; of several extensions where only one has more than one numbered file. A single
// mesh file is frame 0.
Result<FrameFiles> frames_of_folder(const std::filesystem::path& folder, const ClipOptions& options);

// A single file is frame 0.
Result<FrameFiles> frames_of_file(const std::filesystem::path& file, const ClipOptions& options);

// kBadInput where options.first lies after options.last, kNotFound where one of them lies outside of [first, last].
// `where` names the clip.
Result<void> check_range(const ClipOptions& options, std::uint32_t first, std::uint64_t last, const std::string& where);

}  // namespace limber
