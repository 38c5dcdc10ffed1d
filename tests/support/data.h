// SPDX-License-Identifier: Apache-2.0
// Where tests find the real clips. They are not part of the repository: `./test` unpacks them from
// ../shared/data to $LIMBER_DATA (default: build/data); a test whose data is missing says that it skips.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace limber::test {

// The folder of a data set such as "horse-gallop" or "static"; nothing where it is not unpacked.
inline std::optional<std::filesystem::path> data_set(const std::string& name) {
  const char* root = std::getenv("LIMBER_DATA");
  std::filesystem::path folder = root ? root : std::filesystem::path(LIMBER_SOURCE_DIR) / "build" / "data";
  folder /= name;
  if (!std::filesystem::is_directory(folder)) return std::nullopt;
  return folder;
}

}  // namespace limber::test

// Declares `folder`, or skips the test and says so. Use inside a TEST body: LIMBER_DATA_SET(folder, "crane");
#define LIMBER_DATA_SET(folder, name)                                                                \
  const auto folder##_or_nothing = ::limber::test::data_set(name);                                   \
  if (!folder##_or_nothing) GTEST_SKIP() << "data set " << (name) << " is not unpacked; see ./test"; \
  const std::filesystem::path folder = *folder##_or_nothing
