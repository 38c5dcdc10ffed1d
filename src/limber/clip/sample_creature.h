// SPDX-License-Identifier: Apache-2.0
// The creature of the samples: a skeleton with flesh on it that can stand as a quadruped, like a horse, as a biped,
// like a man, or as anything between the two. Units are about metres; y is up, z forward, x to its left.
#pragma once

#include <array>
#include <vector>

#include "limber/clip/sample_body.h"

namespace limber {

// Joints of the middle, then those of the left side, then those of the right.
enum Joint : int {
  kPelvis,
  kLoin,
  kChest,
  kNeckBase,
  kNeckMiddle,
  kPoll,  // where the neck meets the skull
  kFace,
  kNose,
  kChin,
  kNoseTip,
  kDock,  // where the tail begins
  kTail1,
  kTail2,
  kTail3,
  kMane1,
  kMane2,
  kMane3,
  kBelly,
  kSides,
  kShoulder = 0,  // added to side(...)
  kElbow,
  kKnee,
  kFrontFetlock,
  kFrontToe,
  kHip,
  kStifle,
  kHock,
  kHindFetlock,
  kHindToe,
  kEarBase,
  kEarTip,
  kEye,
  kNostril,
  kCheek,
  kBreast,
  kHaunch,
  kFinger,  // five fingers of two joints each
  kSideCount = kFinger + 10,
  kJointCount = kSides + 2 * kSideCount,
};

constexpr int side(int which, int joint) { return kSides + which * kSideCount + joint; }

// 0 is the quadruped, 1 the biped. Bones keep their way between: directions turn, lengths and radii go linearly.
struct Creature {
  std::array<int, kJointCount> parents{};
  std::array<Vec3d, kJointCount> joints{};
  struct Flesh {
    int from = 0, to = 0;  // joints; the flesh moves with the bone that ends in `to`
    Limb limb;
  };
  std::vector<Flesh> flesh;

  std::vector<Limb> limbs() const;
};

Creature creature_between(double share);

// The quadruped, without what only the biped has.
Creature quadruped();

// Ribs, folds of the neck and the joints, muscles, strands of the mane: heights over the body's surface, for points
// of the standing quadruped or biped.
class QuadrupedRelief : public Relief {
 public:
  double height(const Vec3d& point) const override;
};
class BipedRelief : public Relief {
 public:
  double height(const Vec3d& point) const override;
};

}  // namespace limber
