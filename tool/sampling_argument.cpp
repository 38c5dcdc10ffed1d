// SPDX-License-Identifier: Apache-2.0
#include "tool/sampling_argument.h"

#include <map>
#include <string>

namespace limber::tool {

void declare_sampling(CLI::App& app, eval::DistanceOptions& options) {
  static const std::map<std::string, eval::Sampling> kSamplings = {{"area", eval::Sampling::kArea},
                                                                   {"metro", eval::Sampling::kMetro}};
  app.add_option_function<std::string>(
         "--sampling", [&options](const std::string& name) { options.sampling = kSamplings.at(name); },
         "area: samples uniform by area; metro: as Metro's default, for comparison with published values")
      ->type_name("KIND")
      ->check(CLI::IsMember(std::vector<std::string>{"area", "metro"}))
      ->default_str("area");
  app.add_option_function<std::size_t>(
         "--samples",
         [&options](const std::size_t& count) {
           options.samples.per_triangle = 0;
           options.samples.at_least = count;
         },
         "samples on each surface; otherwise 10 per triangle, and 100,000 at least")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}));
  app.add_option("--seed", options.samples.seed, "of the samples' places")->type_name("N")->capture_default_str();
}

}  // namespace limber::tool
