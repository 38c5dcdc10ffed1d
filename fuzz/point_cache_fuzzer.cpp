// SPDX-License-Identifier: Apache-2.0
// The readers of point caches: the first byte chooses the format, the rest is the file, beside a mesh of three
// vertices.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

#include "limber/clip/clip.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace limber;
  namespace fs = std::filesystem;
  static const fs::path folder = fs::temp_directory_path() / ("limber-fuzz-" + std::to_string(getpid()));
  if (fs::create_directories(folder)) {
    std::atexit([] { fs::remove_all(folder); });
    std::ofstream(folder / "base.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  }
  if (size == 0) return 0;
  const fs::path path = folder / (data[0] % 2 == 0 ? "a.pc2" : "a.mdd");
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  const Result<std::unique_ptr<ClipReader>> clip = open_clip(path.string(), {});
  if (!clip) return 0;
  if (*(*clip)->frame_count() > size / 36) std::abort();
  std::vector<Vec3f> positions(3);
  for (Result<bool> more = (*clip)->read(positions); more && *more; more = (*clip)->read(positions)) {
    for (const Vec3f& position : positions) {
      if (!is_finite(position)) std::abort();
    }
  }
  return 0;
}
