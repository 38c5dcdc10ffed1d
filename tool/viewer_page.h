// SPDX-License-Identifier: Apache-2.0
// The viewer: one page with its script, its style and the player inside (web/, scripts/build-web).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "limber/base/result.h"

namespace limber::tool {

// Looked for in share/limber beside the folder that the program lies in: of a build, and of an installation.
// Error kNotFound: this limber was built without it.
Result<std::string> read_viewer_page();

// The page with a stream inside, which needs no server. `name` is what it shows as the stream's.
// Precondition: `page` is what read_viewer_page() gave.
std::string with_stream(std::string_view page, std::span<const std::byte> stream, std::string_view name);

}  // namespace limber::tool
