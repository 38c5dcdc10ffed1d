// SPDX-License-Identifier: Apache-2.0
#include "tool/part_argument.h"

#include <algorithm>
#include <fmt/format.h>

#include "tool/exit.h"
#include "tool/numbers.h"

namespace limber::tool {
namespace {

eval::PartBall parse_part(const std::string& text) {
  const auto refuse = [&] {
    return UsageError(fmt::format(
        "--part {}: give a name, the middle of a ball in the first frame and its radius, as in ear=0.1,0.4,0.2,0.05",
        text));
  };
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) throw refuse();
  if (text.find_first_of("/\\:*?\"<>| ") < equals)
    throw UsageError(fmt::format("--part {}: the name becomes that of a file: leave out spaces and slashes", text));
  double numbers[4] = {};
  if (!parse_numbers(std::string_view(text).substr(equals + 1), numbers) || !(numbers[3] > 0)) throw refuse();
  return {text.substr(0, equals), {numbers[0], numbers[1], numbers[2]}, numbers[3]};
}

}  // namespace

void declare_part(CLI::App& app, std::vector<std::string>& texts) {
  app.add_option("--part", texts,
                 "a part to look at by itself: what of the first frame lies in a ball, given by its middle and radius, "
                 "as in ear=0.1,0.4,0.2,0.05; may be given again")
      ->type_name("NAME=X,Y,Z,R")
      ->allow_extra_args(false);
}

std::vector<eval::PartBall> wanted_parts(const std::vector<std::string>& texts) {
  std::vector<eval::PartBall> parts;
  for (const std::string& text : texts) {
    parts.push_back(parse_part(text));
    if (std::ranges::count(parts, parts.back().name, &eval::PartBall::name) > 1)
      throw UsageError(fmt::format("--part {} is given twice", parts.back().name));
  }
  return parts;
}

}  // namespace limber::tool
