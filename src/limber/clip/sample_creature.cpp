// SPDX-License-Identifier: Apache-2.0
#include "limber/clip/sample_creature.h"

#include <algorithm>
#include <cmath>

#include "limber/base/portable_math.h"

namespace limber {
namespace {

struct JointRow {
  int joint, parent;
  Vec3d quadruped, biped;
};

constexpr JointRow kMiddleJoints[] = {
    {kPelvis, -1, {0.0, 1.20, -0.52}, {0.0, 1.00, -0.01}},
    {kLoin, kPelvis, {0.0, 1.17, -0.10}, {0.0, 1.17, 0.01}},
    {kChest, kLoin, {0.0, 1.15, 0.34}, {0.0, 1.40, -0.01}},
    {kBelly, kLoin, {0.0, 1.02, 0.02}, {0.0, 1.12, 0.05}},
    {kNeckBase, kChest, {0.0, 1.33, 0.56}, {0.0, 1.57, -0.03}},
    {kNeckMiddle, kNeckBase, {0.0, 1.60, 0.77}, {0.0, 1.64, -0.02}},
    {kPoll, kNeckMiddle, {0.0, 1.84, 0.94}, {0.0, 1.80, -0.02}},
    {kFace, kPoll, {0.0, 1.72, 1.15}, {0.0, 1.76, 0.03}},
    {kNose, kFace, {0.0, 1.53, 1.33}, {0.0, 1.70, 0.06}},
    {kChin, kFace, {0.0, 1.49, 1.27}, {0.0, 1.665, 0.07}},
    {kNoseTip, kFace, {0.0, 1.56, 1.32}, {0.0, 1.735, 0.135}},
    {kDock, kPelvis, {0.0, 1.30, -0.80}, {0.0, 1.00, -0.08}},
    {kTail1, kDock, {0.0, 1.16, -0.98}, {0.0, 0.995, -0.085}},
    {kTail2, kTail1, {0.0, 0.86, -1.10}, {0.0, 0.985, -0.09}},
    {kTail3, kTail2, {0.0, 0.50, -1.10}, {0.0, 0.975, -0.09}},
    {kMane1, kPoll, {0.0, 1.93, 0.86}, {0.0, 1.86, -0.06}},
    {kMane2, kNeckMiddle, {0.0, 1.73, 0.66}, {0.0, 1.78, -0.09}},
    {kMane3, kNeckBase, {0.0, 1.47, 0.43}, {0.0, 1.70, -0.08}},
};

constexpr JointRow kSideJoints[] = {
    {kShoulder, kChest, {0.15, 1.10, 0.42}, {0.20, 1.49, -0.02}},
    {kElbow, kShoulder, {0.19, 0.78, 0.36}, {0.37, 1.22, -0.04}},
    {kKnee, kElbow, {0.175, 0.47, 0.41}, {0.51, 0.99, 0.05}},
    {kFrontFetlock, kKnee, {0.17, 0.16, 0.40}, {0.555, 0.915, 0.085}},
    {kFrontToe, kFrontFetlock, {0.17, 0.045, 0.47}, {0.57, 0.89, 0.095}},
    {kHip, kPelvis, {0.13, 1.16, -0.54}, {0.11, 0.97, -0.01}},
    {kStifle, kHip, {0.19, 0.84, -0.42}, {0.14, 0.55, 0.03}},
    {kHock, kStifle, {0.175, 0.51, -0.70}, {0.145, 0.13, -0.03}},
    {kHindFetlock, kHock, {0.17, 0.16, -0.63}, {0.155, 0.065, 0.06}},
    {kHindToe, kHindFetlock, {0.17, 0.045, -0.56}, {0.175, 0.045, 0.17}},
    {kEarBase, kPoll, {0.065, 1.93, 0.93}, {0.105, 1.775, -0.01}},
    {kEarTip, kEarBase, {0.10, 2.11, 0.94}, {0.118, 1.80, -0.03}},
    {kEye, kFace, {0.082, 1.80, 1.10}, {0.042, 1.775, 0.10}},
    {kNostril, kNose, {0.045, 1.53, 1.375}, {0.02, 1.722, 0.115}},
    {kCheek, kFace, {0.05, 1.70, 1.04}, {0.06, 1.72, 0.05}},
    {kBreast, kChest, {0.10, 1.05, 0.60}, {0.085, 1.41, 0.085}},
    {kHaunch, kPelvis, {0.13, 1.16, -0.66}, {0.085, 0.95, -0.07}},
};

struct FleshRow {
  int from, to;
  double quadruped_from, quadruped_to, biped_from, biped_to;  // radii
  double blend, size;
  Vec3d flat{1.0, 0.0, 0.0};
  double squash = 1.0;
};

// Later flesh blends onto earlier flesh.
constexpr FleshRow kMiddleFlesh[] = {
    {kPelvis, kLoin, 0.255, 0.27, 0.150, 0.135, 0.10, 1.0},
    {kLoin, kChest, 0.27, 0.275, 0.135, 0.165, 0.12, 1.0},
    {kBelly, kBelly, 0.26, 0.26, 0.13, 0.13, 0.15, 1.0},
    {kChest, kNeckBase, 0.25, 0.185, 0.155, 0.085, 0.15, 0.9},
    {kNeckBase, kNeckMiddle, 0.185, 0.135, 0.075, 0.065, 0.10, 0.8},
    {kNeckMiddle, kPoll, 0.135, 0.105, 0.065, 0.112, 0.08, 0.7},
    {kPoll, kFace, 0.115, 0.092, 0.112, 0.095, 0.06, 0.5},
    {kFace, kNose, 0.092, 0.068, 0.095, 0.070, 0.05, 0.45},
    {kFace, kChin, 0.070, 0.050, 0.070, 0.045, 0.04, 0.4},
    {kNoseTip, kNoseTip, 0.030, 0.030, 0.024, 0.024, 0.035, 0.35},
    {kPelvis, kDock, 0.20, 0.075, 0.10, 0.02, 0.08, 0.8},
    {kDock, kTail1, 0.062, 0.060, 0.035, 0.030, 0.06, 0.6},
    {kTail1, kTail2, 0.060, 0.075, 0.028, 0.022, 0.03, 0.6},
    {kTail2, kTail3, 0.075, 0.020, 0.022, 0.010, 0.03, 0.55},
    {kMane1, kMane2, 0.070, 0.095, 0.06, 0.06, 0.03, 0.5, {1.0, 0.0, 0.0}, 0.40},
    {kMane2, kMane3, 0.095, 0.080, 0.06, 0.05, 0.03, 0.5, {1.0, 0.0, 0.0}, 0.40},
};

constexpr FleshRow kSideFlesh[] = {
    {kBreast, kBreast, 0.120, 0.120, 0.090, 0.090, 0.09, 0.9},
    {kHaunch, kHaunch, 0.175, 0.175, 0.105, 0.105, 0.10, 0.9},
    {kShoulder, kElbow, 0.165, 0.085, 0.088, 0.060, 0.05, 0.8},
    {kElbow, kKnee, 0.085, 0.058, 0.066, 0.042, 0.04, 0.6},
    {kKnee, kFrontFetlock, 0.060, 0.045, 0.040, 0.044, 0.035, 0.5},
    {kFrontFetlock, kFrontToe, 0.047, 0.066, 0.046, 0.050, 0.025, 0.42},
    {kHip, kStifle, 0.205, 0.120, 0.115, 0.078, 0.07, 0.85},
    {kStifle, kHock, 0.115, 0.056, 0.080, 0.046, 0.05, 0.65},
    {kHock, kHindFetlock, 0.060, 0.045, 0.050, 0.046, 0.035, 0.5},
    {kHindFetlock, kHindToe, 0.047, 0.066, 0.048, 0.042, 0.025, 0.42},
    {kEarBase, kEarTip, 0.048, 0.012, 0.030, 0.028, 0.03, 0.33, {0.0, 0.0, 1.0}, 0.5},
    {kCheek, kCheek, 0.078, 0.078, 0.040, 0.040, 0.04, 0.45},
    {kEye, kEye, 0.027, 0.027, 0.020, 0.020, 0.012, 0.28},
    {kNostril, kNostril, 0.030, 0.030, 0.014, 0.014, 0.02, 0.3},
};

Vec3d mirrored(const Vec3d& v) { return {-v.x, v.y, v.z}; }
double blend(double a, double b, double share) { return a + (b - a) * share; }
Vec3d blend(const Vec3d& a, const Vec3d& b, double share) { return a + (b - a) * share; }

// Where bone `to - from` of the one pose lies on its way to the other: the direction turns, the length goes linearly.
Vec3d turned_bone(const Vec3d& quadruped, const Vec3d& biped, double share) {
  const double first = length(quadruped), second = length(biped);
  if (first < 1e-9 || second < 1e-9) return blend(quadruped, biped, share);
  const Vec3d direction = blend(quadruped * (1.0 / first), biped * (1.0 / second), share);
  return direction * (blend(first, second, share) / length(direction));
}

struct Tables {
  std::array<JointRow, kJointCount> joints{};
  std::vector<FleshRow> flesh;
};

// The hand: four fingers in a fan and a thumb, which lie within the quadruped's hoof.
void add_hand(Tables& tables) {
  const JointRow toe = tables.joints[static_cast<std::size_t>(side(0, kFrontToe))];
  constexpr Vec3d kAlong{0.50, -0.78, 0.37}, kAcross{-0.22, 0.30, 0.93};
  for (int finger = 0; finger < 5; ++finger) {
    const bool thumb = finger == 4;
    const double spread = thumb ? 1.25 : 1.5 - finger;
    const Vec3d root = toe.biped + kAcross * (spread * (thumb ? 0.040 : 0.031)) + kAlong * (thumb ? -0.05 : 0.0);
    Vec3d way = thumb ? kAlong * 0.6 + kAcross * 0.8 : kAlong + kAcross * (spread * 0.16);
    way = way * (1.0 / length(way));
    const double reach = thumb ? 0.095 : 0.135 - 0.02 * std::fabs(spread - 0.3);
    const Vec3d in_hoof = toe.quadruped + Vec3d{-0.012 * spread, 0.0, 0.0};
    const int middle = kFinger + 2 * finger;
    const JointRow rows[] = {{middle, kFrontToe, in_hoof, root},
                             {middle + 1, middle, in_hoof + Vec3d{0.0, -0.012, 0.006}, root + way * reach}};
    for (const JointRow& row : rows) {
      for (int which = 0; which < 2; ++which) {
        tables.joints[static_cast<std::size_t>(side(which, row.joint))] = {
            side(which, row.joint), side(which, row.parent), which == 0 ? row.quadruped : mirrored(row.quadruped),
            which == 0 ? row.biped : mirrored(row.biped)};
      }
    }
    for (int which = 0; which < 2; ++which) {
      tables.flesh.push_back({side(which, middle), side(which, middle + 1), 0.020, 0.010, 0.0215, 0.0165, 0.010, 0.2});
    }
  }
}

Tables make_tables() {
  Tables tables;
  for (const JointRow& row : kMiddleJoints) tables.joints[static_cast<std::size_t>(row.joint)] = row;
  tables.flesh.assign(std::begin(kMiddleFlesh), std::end(kMiddleFlesh));
  for (int which = 0; which < 2; ++which) {
    for (const JointRow& row : kSideJoints) {
      // A parent in the table of the sides is one of the same side, except for those of the trunk and the head.
      const bool in_middle = row.joint == kShoulder || row.joint == kHip || row.joint == kEarBase ||
                             row.joint == kEye || row.joint == kNostril || row.joint == kCheek ||
                             row.joint == kBreast || row.joint == kHaunch;
      tables.joints[static_cast<std::size_t>(side(which, row.joint))] = {
          side(which, row.joint), in_middle ? row.parent : side(which, row.parent),
          which == 0 ? row.quadruped : mirrored(row.quadruped), which == 0 ? row.biped : mirrored(row.biped)};
    }
    for (FleshRow row : kSideFlesh) {
      row.from = side(which, row.from), row.to = side(which, row.to);
      tables.flesh.push_back(row);
    }
  }
  add_hand(tables);
  return tables;
}

Creature make_creature(double share, bool with_hands) {
  const Tables tables = make_tables();
  Creature creature;
  for (int joint = 0; joint < kJointCount; ++joint) {
    const JointRow& row = tables.joints[static_cast<std::size_t>(joint)];
    creature.parents[static_cast<std::size_t>(joint)] = row.parent;
    Vec3d& point = creature.joints[static_cast<std::size_t>(joint)];
    if (row.parent < 0) {
      point = blend(row.quadruped, row.biped, share);
    } else {
      const JointRow& parent = tables.joints[static_cast<std::size_t>(row.parent)];
      point = creature.joints[static_cast<std::size_t>(row.parent)] +
              turned_bone(row.quadruped - parent.quadruped, row.biped - parent.biped, share);
    }
  }
  for (const FleshRow& row : tables.flesh) {
    const bool hand = (row.from - kSides) % kSideCount >= kFinger && row.from >= kSides;
    if (hand && !with_hands) continue;
    Limb limb{.a = creature.joints[static_cast<std::size_t>(row.from)],
              .b = creature.joints[static_cast<std::size_t>(row.to)],
              .radius_a = blend(row.quadruped_from, row.biped_from, share),
              .radius_b = blend(row.quadruped_to, row.biped_to, share),
              .flat = row.flat,
              .squash = row.squash,
              .blend = row.blend * blend(1.0, 0.7, share),
              .size = row.size};
    creature.flesh.push_back({row.from, row.to, limb});
  }
  return creature;
}

// 1 between low and high, and smoothly 0 outside over the margin.
double window(double x, double low, double high, double margin) {
  const double rise = std::clamp((x - low) / margin + 1.0, 0.0, 1.0);
  const double fall = std::clamp((high - x) / margin + 1.0, 0.0, 1.0);
  return rise * rise * (3.0 - 2.0 * rise) * fall * fall * (3.0 - 2.0 * fall);
}

}  // namespace

std::vector<Limb> Creature::limbs() const {
  std::vector<Limb> result;
  for (const Flesh& part : flesh) result.push_back(part.limb);
  return result;
}

Creature creature_between(double share) { return make_creature(share, true); }

Creature quadruped() { return make_creature(0.0, false); }

double QuadrupedRelief::height(const Vec3d& p) const {
  double height = 0.0;
  const double trunk = window(p.z, -0.75, 0.5, 0.15) * window(p.y, 0.75, 1.6, 0.1);
  if (trunk > 0.0) {
    const double ribs = window(p.z, -0.22, 0.22, 0.12) * window(p.y, 0.96, 1.22, 0.10);
    if (ribs > 0.0) height += 0.0085 * ribs * portable_sin((p.z + 0.35 * (p.y - 1.1)) * (2.0 * kPi / 0.105));
    height += trunk * 0.010 * portable_sin(11.0 * p.x + 3.0 * p.z) * portable_sin(9.0 * p.z + 1.0) *
              portable_sin(10.0 * p.y + 2.0);
  }
  // Folds across the neck, and strands of the mane on its crest.
  const double along = (p.y - 1.33) * 0.79 + (p.z - 0.56) * 0.61, across = (p.z - 0.56) * 0.79 - (p.y - 1.33) * 0.61;
  const double neck = window(along, 0.02, 0.48, 0.08) * window(across, -0.4, 0.35, 0.05);
  if (neck > 0.0) {
    const double crest = window(across, -0.5, -0.13, 0.04);
    height += neck * (1.0 - crest) * 0.007 * portable_sin(along * (2.0 * kPi / 0.095) + 6.0 * across);
    height += neck * crest * 0.005 * portable_sin(along * (2.0 * kPi / 0.062) + 9.0 * across);
  }
  const double tail = window(p.y, 0.55, 1.1, 0.12) * window(p.z, -1.4, -0.95, 0.04);
  if (tail > 0.0) height += tail * 0.008 * portable_sin(70.0 * p.x + 40.0 * (p.z + 1.1) + 9.0 * p.y);
  // Tendons of the legs and rings at the hooves.
  const double leg = window(p.y, 0.10, 0.80, 0.08) * window(p.z, -0.85, 0.6, 0.05) * (p.z > -0.95 ? 1.0 : 0.0);
  if (leg > 0.0) height += leg * 0.004 * portable_sin(22.0 * p.y) * portable_sin(60.0 * p.z + 2.0);
  const double hoof = window(p.y, -0.1, 0.07, 0.02);
  if (hoof > 0.0) height += hoof * 0.004 * portable_sin(p.y * (2.0 * kPi / 0.035));
  return height;
}

double BipedRelief::height(const Vec3d& p) const {
  double height = 0.0;
  const double front = p.z > 0.03 ? std::clamp((p.z - 0.03) / 0.06, 0.0, 1.0) : 0.0;
  const double belly = window(p.y, 1.05, 1.28, 0.05) * window(p.x, -0.10, 0.10, 0.04) * front;
  if (belly > 0.0) {
    height += belly * 0.008 * (portable_cos((p.y - 1.06) * (2.0 * kPi / 0.085)) + 0.5);
    height -= belly * 0.008 * window(p.x, -0.006, 0.006, 0.02);
  }
  const double back = p.z < -0.06 ? std::clamp((-0.06 - p.z) / 0.05, 0.0, 1.0) : 0.0;
  if (back > 0.0) height -= back * 0.012 * window(p.y, 1.08, 1.5, 0.06) * window(p.x, -0.005, 0.005, 0.03);
  const double hair = window(p.y, 1.80, 2.0, 0.03) * window(p.z, -0.3, 0.0, 0.05);
  if (hair > 0.0) height += hair * 0.006 * portable_sin(95.0 * p.x + 20.0 * p.z);
  const double limbs = window(p.y, 0.15, 0.9, 0.05) + window(std::fabs(p.x), 0.26, 0.6, 0.05);
  if (limbs > 0.0) height += std::fmin(limbs, 1.0) * 0.005 * portable_sin(17.0 * p.y) * portable_sin(45.0 * p.z + 1.0);
  return height;
}

}  // namespace limber
