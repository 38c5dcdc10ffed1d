// SPDX-License-Identifier: Apache-2.0
#include "tool/recluster_argument.h"

#include <map>
#include <memory>
#include <optional>

#include "tool/ranges.h"

namespace limber::tool {
namespace {

// What was given; the rest is as `follow` says.
struct Given {
  Follow follow = Follow::kBalanced;
  std::optional<double> threshold, hysteresis, coarser_weight, growth, restart, most_changed;
  std::optional<unsigned> rounds;

  ReclusterOptions apply() const {
    ReclusterOptions options = recluster_options(follow);
    options.growth = growth;
    if (threshold) options.threshold = *threshold;
    if (hysteresis) options.rebirth.hysteresis = *hysteresis;
    if (restart) options.restart.gain = *restart;
    if (restart && !(*restart > 0)) options.restart.jump = 0;
    if (most_changed) options.most_changed = *most_changed;
    if (coarser_weight) options.coarser_weight = *coarser_weight;
    if (rounds) options.fit.rounds = *rounds;
    return options;
  }
};

}  // namespace

void declare_recluster(CLI::App& app, ReclusterOptions& options, const std::string& group) {
  const auto given = std::make_shared<Given>();
  static const std::map<std::string, Follow> kFollows = {
      {"calm", Follow::kCalm}, {"balanced", Follow::kBalanced}, {"close", Follow::kClose}, {"paper", Follow::kPaper}};
  app.add_option("--follow", given->follow,
                 "calm: fewer changes; close: nearer to every frame, and slower; paper: swaps alone, as Kircher and "
                 "Garland (balanced)")
      ->transform(CLI::CheckedTransformer(kFollows, CLI::ignore_case).description(""))
      ->type_name("calm|balanced|close|paper")
      ->group(group);
  app.add_option("--threshold", given->threshold,
                 "least benefit of a change, as a share of the mean error of the clusters on its level")
      ->check(in_range(0, 1e6))
      ->type_name("X")
      ->group(group);
  app.add_option("--hysteresis", given->hysteresis,
                 "what the birth of a cluster must gain for what the death of another costs; 0: no births")
      ->check(in_range(0, 1e6))
      ->type_name("X")
      ->group(group);
  app.add_option(
         "--restart", given->restart,
         "where the clip jumps, make the hierarchy anew if that leaves less than this share of the error; 0: never")
      ->check(in_range(0, 1))
      ->type_name("SHARE")
      ->group(group);
  app.add_option("--max-changed", given->most_changed,
                 "at most this share of the triangles of each level is new in a frame, as in 0.03")
      ->check(in_range(0, 1))
      ->type_name("SHARE")
      ->group(group);
  app.add_option("--fit", given->rounds,
                 "how often the levels are fitted to the surface; 0: their nodes stand at the minima of their quadrics")
      ->check(in_range(0, 100))
      ->type_name("N")
      ->group(group);
  app.add_option("--coarser-weight", given->coarser_weight, "weight of each level against the one below it")
      ->check(above_zero(1e6))
      ->type_name("X")
      ->group(group);
  app.add_option("--growth", given->growth,
                 "how fast errors grow as levels get smaller: an exponent; fitted to the clip where not given")
      ->check(above_zero(10))
      ->type_name("X")
      ->group(group);
  app.parse_complete_callback([given, &options] { options = given->apply(); });
}

}  // namespace limber::tool
