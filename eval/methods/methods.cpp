// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "eval/methods/factories.h"
#include "eval/methods/method.h"
#include "eval/peers/peers.h"

namespace limber::eval {
namespace {

constexpr MethodInfo kOurs[] = {
    {"direct", "every frame by itself, by edge contraction (QSlim)", true, Sees::kFirst, make_direct},
    {"direct-volume", "as direct, by what keeps the volume and the borders (Lindstrom & Turk)", true, Sees::kFirst,
     make_direct_volume},
    {"improved", "as direct, its clusters then improved by swaps on the same frame", true, Sees::kFirst, make_improved},
    {"first-frame", "the clusters of the first frame, placed anew in every frame", false, Sees::kFirst,
     make_first_frame},
    {"rest-pose", "vertices of the first frame's simplification, as game engines do", false, Sees::kFirst,
     make_rest_pose},
    {"four-face", "vertices of the first frame's simplification by four-face clusters (Velho)", false, Sees::kFirst,
     make_four_face},
    {"four-face-front", "one structure of four-face clusters for all frames, a front of it in each (Velho, on clips)",
     false, Sees::kMany, make_four_face_front},
    {"dsd", "one clustering under the sum of all frames' errors (Mohr & Gleicher)", false, Sees::kMany, make_dsd},
    {"average", "one clustering under the largest of all frames' errors", false, Sees::kMany, make_average},
    {"pose-independent", "the first frame contracted under its quadrics in all frames (DeCoro & Rusinkiewicz)", false,
     Sees::kMany, make_pose_independent},
    {"deformation-oriented", "as dsd, with more weight where the surface deforms (Huang, Chen & Chuang)", false,
     Sees::kMany, make_deformation_oriented},
    {"best-cut", "one hierarchy, cut anew in every frame by the frame's own errors", false, Sees::kMany, make_best_cut},
    {"multilevel", "a hierarchy that follows the clip by swaps, cut at the size asked for", false, Sees::kBase,
     make_multilevel},
    {"feature", "one sequence of contractions for all frames, the last of them chosen in each frame (Zhang & Wu)",
     false, Sees::kMany, make_feature},
    {"t-dag", "every frame's own contractions, as far as they fit those of the frame before (Shamir, Bajaj & Pascucci)",
     false, Sees::kFirst, make_t_dag},
};

std::vector<MethodInfo> ours_and_peers() {
  std::vector<MethodInfo> all(std::begin(kOurs), std::end(kOurs));
  const std::span<const MethodInfo> theirs = peers();
  all.insert(all.end(), theirs.begin(), theirs.end());
  return all;
}

}  // namespace

std::span<const MethodInfo> methods() {
  static const std::vector<MethodInfo> all = ours_and_peers();
  return all;
}

const MethodInfo* find_method(std::string_view name) {
  const std::span<const MethodInfo> all = methods();
  const auto found = std::ranges::find(all, name, &MethodInfo::name);
  return found == all.end() ? nullptr : &*found;
}

void name_corners(const Approximation& approximation, std::vector<Triangle>& ids) {
  ids = approximation.triangles;
  for (Triangle& triangle : ids) {
    for (Index& corner : triangle) corner = approximation.nodes[corner];
  }
}

}  // namespace limber::eval
