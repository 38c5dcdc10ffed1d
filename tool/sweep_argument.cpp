// SPDX-License-Identifier: Apache-2.0
#include "tool/sweep_argument.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <string_view>

#include "tool/exit.h"
#include "tool/suggest.h"

namespace limber::tool {
namespace {

struct Parameter {
  std::string_view name;
  std::string_view method;
  double& (*value)(eval::MethodOptions&);
};

constexpr Parameter kParameters[] = {
    {"unified", "feature", [](eval::MethodOptions& o) -> double& { return o.feature.unified_share; }},
    {"k1", "feature", [](eval::MethodOptions& o) -> double& { return o.feature.deformation; }},
    {"k2", "feature", [](eval::MethodOptions& o) -> double& { return o.feature.feature; }},
    {"sharp-angle", "feature", [](eval::MethodOptions& o) -> double& { return o.feature.sharp_angle; }},
    {"threshold", "multilevel", [](eval::MethodOptions& o) -> double& { return o.recluster.threshold; }},
    {"hysteresis", "multilevel", [](eval::MethodOptions& o) -> double& { return o.recluster.rebirth.hysteresis; }},
    {"branching", "multilevel", [](eval::MethodOptions& o) -> double& { return o.branching; }},
    {"coarser-weight", "multilevel", [](eval::MethodOptions& o) -> double& { return o.recluster.coarser_weight; }},
    {"history", "t-dag", [](eval::MethodOptions& o) -> double& { return o.history; }},
};

const Parameter& find_parameter(const std::string& name) {
  const auto* const found = std::ranges::find(kParameters, name, &Parameter::name);
  if (found != std::end(kParameters)) return *found;
  std::vector<std::string> names;
  for (const Parameter& known : kParameters) names.emplace_back(known.name);
  const std::string meant = nearest(name, names);
  throw UsageError(fmt::format("there is no parameter \"{}\" to sweep; {}there are {}", name,
                               meant.empty() ? "" : fmt::format("did you mean \"{}\"? ", meant),
                               fmt::join(names, ", ")));
}

double parse_value(const std::string& text, std::string_view parameter) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw UsageError(fmt::format("--sweep {}: \"{}\" is no number", parameter, text));
  return value;
}

WantedSweep parse_sweep(const std::string& text, CLI::App& app) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw UsageError(fmt::format("--sweep {}: give a parameter and its values, as in unified=1,0.96,0.8", text));
  const Parameter& parameter = find_parameter(text.substr(0, equals));
  CLI::Option& option = *app.get_option(fmt::format("--{}", parameter.name));
  WantedSweep sweep{.parameter = std::string(parameter.name),
                    .method = eval::find_method(parameter.method),
                    .value = parameter.value,
                    .values = {}};
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    std::string word = text.substr(begin, end - begin);
    sweep.values.push_back(parse_value(word, parameter.name));
    // Without a name: the only rule that the option has.
    const std::string complaint = (*option.get_validator())(word);
    if (!complaint.empty()) throw UsageError(fmt::format("--sweep {}: {}", parameter.name, complaint));
    begin = end + 1;
  }
  std::ranges::sort(sweep.values);
  sweep.values.erase(std::unique(sweep.values.begin(), sweep.values.end()), sweep.values.end());
  if (sweep.values.size() < 2) throw UsageError(fmt::format("--sweep {}: give at least two values", parameter.name));
  return sweep;
}

}  // namespace

void declare_sweep(CLI::App& app, std::vector<std::string>& texts) {
  std::vector<std::string_view> names;
  for (const Parameter& parameter : kParameters) names.push_back(parameter.name);
  app.add_option("--sweep", texts,
                 fmt::format("a parameter at several values, as in unified=1,0.96,0.8; may be given again: {}",
                             fmt::join(names, ", ")))
      ->type_name("NAME=X,...")
      ->allow_extra_args(false);
}

std::vector<WantedSweep> wanted_sweeps(const std::vector<std::string>& texts, CLI::App& app) {
  std::vector<WantedSweep> sweeps;
  for (const std::string& text : texts) {
    sweeps.push_back(parse_sweep(text, app));
    if (std::ranges::count(sweeps, sweeps.back().parameter, &WantedSweep::parameter) > 1)
      throw UsageError(fmt::format("--sweep {} is given twice", sweeps.back().parameter));
  }
  return sweeps;
}

}  // namespace limber::tool
