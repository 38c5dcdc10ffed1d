// SPDX-License-Identifier: Apache-2.0
// The quadruped in a gallop: a stride is a set of angles that swing once per cycle, each with its own delay; the skin
// follows its bones smoothly, and ripples, tail and ears lag behind.
#include <algorithm>
#include <array>

#include "limber/base/portable_math.h"
#include "limber/clip/sample_creature.h"
#include "limber/clip/sample_motion.h"
#include "limber/clip/sample_skin.h"
#include "limber/clip/sample_surface.h"

namespace limber {
namespace {

constexpr std::uint32_t kFramesPerStride = 30;  // about; a whole number of strides fits the clip
constexpr double kExtractSpacing = 0.026;
constexpr double kSoftness = 0.032;

double wave(double turns) { return portable_sin(2.0 * kPi * turns); }

struct BonePose {
  double sine = 0.0, cosine = 1.0;  // of the turn that swings what hangs down forward
  Vec3d joint;

  Vec3d turn(const Vec3d& v) const { return {v.x, v.y * cosine + v.z * sine, v.z * cosine - v.y * sine}; }
};

// Each bone's own angle, added to its parent's.
std::array<double, kJointCount> angles_at(double phase) {
  std::array<double, kJointCount> angles{};
  const auto set = [&](int joint, double angle) { angles[static_cast<std::size_t>(joint)] = angle; };
  set(kPelvis, -0.10 * wave(phase + 0.05));
  set(kLoin, 0.20 * wave(phase));
  set(kChest, 0.05 * wave(phase - 0.05));
  set(kNeckBase, -0.06 - 0.10 * wave(phase - 0.10));
  set(kNeckMiddle, -0.12 - 0.10 * wave(phase - 0.16));
  set(kPoll, -0.05 + 0.05 * wave(phase - 0.2));
  set(kFace, 0.10 + 0.10 * wave(phase - 0.22));
  set(kDock, -0.20);
  set(kTail1, -0.40 + 0.22 * wave(phase - 0.10));
  set(kTail2, -0.10 + 0.32 * wave(phase - 0.28));
  set(kTail3, 0.05 + 0.42 * wave(phase - 0.46));
  constexpr double kFrontDelay[] = {0.40, 0.28}, kHindDelay[] = {0.90, 0.80};
  for (int which = 0; which < 2; ++which) {
    const double front = phase + kFrontDelay[which], hind = phase + kHindDelay[which];
    const double front_up = 0.5 + 0.5 * wave(front + 0.22), hind_up = 0.5 + 0.5 * wave(hind + 0.22);
    const double front_lift = front_up * front_up, hind_lift = hind_up * hind_up;
    set(side(which, kShoulder), 0.12 * wave(front));
    set(side(which, kElbow), 0.05 + 0.50 * wave(front));
    set(side(which, kKnee), -0.05 + 0.55 * front_lift);
    set(side(which, kFrontFetlock), 0.08 - 1.45 * front_lift);
    set(side(which, kFrontToe), 0.20 - 1.00 * front_lift);
    set(side(which, kHip), 0.08 * wave(hind));
    set(side(which, kStifle), 0.10 + 0.50 * wave(hind));
    set(side(which, kHock), 0.05 - 0.80 * hind_lift);
    set(side(which, kHindFetlock), 0.85 * hind_lift - 0.05);
    set(side(which, kHindToe), 0.20 - 1.20 * hind_lift);
    set(side(which, kEarTip), -0.35 - 0.40 * wave(phase - 0.30 - 0.06 * which));
  }
  return angles;
}

class Gallop : public SampleMotion {
 public:
  explicit Gallop(Index vertex_count) : creature_(quadruped()) {
    const std::vector<Limb> limbs = creature_.limbs();
    const Body body(limbs);
    const QuadrupedRelief relief;
    const BodySurface surface{body, &relief};
    rest_ = remesh(surface, extract_surface(surface, kExtractSpacing), vertex_count);
    skin_ = skin_weights(body, rest_.positions, kSoftness);
    for (const Vec3d& p : rest_.positions) {
      const Vec3d up = body.at(p).gradient;
      normals_.push_back(static_cast<Vec3f>(up * (1.0 / length(up))));
    }
  }

  const Mesh& mesh() const override { return rest_.mesh; }

  void pose(std::uint32_t frame, std::uint32_t frame_count, std::span<Vec3f> positions) const override {
    // In whole numbers, so that equal phases are equal to the last bit.
    const std::uint64_t strides = std::max<std::uint32_t>(1, frame_count / kFramesPerStride);
    const double phase = static_cast<double>(frame * strides % frame_count) / frame_count;
    const std::array<BonePose, kJointCount> bones = bones_at(phase);
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const Vec3d p = softened(v, phase);
      Vec3d sum;
      for (Index i = skin_.first[v]; i < skin_.first[v + 1]; ++i) {
        const std::size_t bone = static_cast<std::size_t>(creature_.flesh[skin_.limbs[i]].to);
        const int parent = creature_.parents[bone];
        const std::size_t pivot = parent < 0 ? bone : static_cast<std::size_t>(parent);
        sum += (bones[bone].turn(p - creature_.joints[pivot]) + bones[pivot].joint) *
               static_cast<double>(skin_.weights[i]);
      }
      positions[v] = static_cast<Vec3f>(sum);
    }
  }

 private:
  std::array<BonePose, kJointCount> bones_at(double phase) const {
    const std::array<double, kJointCount> own = angles_at(phase);
    std::array<double, kJointCount> angles{};
    std::array<BonePose, kJointCount> bones;
    for (std::size_t joint = 0; joint < bones.size(); ++joint) {
      const int parent_or_none = creature_.parents[joint];
      const std::size_t parent = static_cast<std::size_t>(std::max(parent_or_none, 0));
      angles[joint] = own[joint] + (parent_or_none < 0 ? 0.0 : angles[parent]);
      bones[joint].sine = portable_sin(angles[joint]);
      bones[joint].cosine = portable_cos(angles[joint]);
      bones[joint].joint =
          parent_or_none < 0
              ? creature_.joints[joint] + Vec3d{0.0, 0.07 * wave(phase + 0.3), 0.03 * wave(phase)}
              : bones[parent].joint + bones[joint].turn(creature_.joints[joint] - creature_.joints[parent]);
    }
    return bones;
  }

  // The vertex at rest, moved by what lags behind: ripples over the trunk, a belly that swings, a tail that sways.
  Vec3d softened(std::size_t v, double phase) const {
    Vec3d p = rest_.positions[v];
    const double trunk = std::clamp((p.y - 0.62) * 4.0, 0.0, 1.0) * std::clamp((p.z + 0.95) * 5.0, 0.0, 1.0) *
                         std::clamp((0.75 - p.z) * 4.0, 0.0, 1.0);
    if (trunk > 0.0) {
      const double ripple = 0.007 * wave(2.0 * phase - 1.9 * p.z - 0.8 * p.y) + 0.005 * wave(3.0 * phase + 4.5 * p.z);
      p += static_cast<Vec3d>(normals_[v]) * (trunk * ripple);
      p.y += 0.030 * trunk * std::clamp((1.15 - p.y) * 3.0, 0.0, 1.0) * wave(phase - 0.1 + 0.2 * p.z);
    }
    const double tail = std::clamp((-0.85 - p.z) * 4.0, 0.0, 1.0) * std::clamp((p.y - 0.2) * 5.0, 0.0, 1.0);
    if (tail > 0.0) p.x += tail * 0.20 * (1.25 - p.y) * wave(phase + 0.5 * p.y);
    return p;
  }

  Creature creature_;
  SurfaceMesh rest_;
  SkinWeights skin_;
  std::vector<Vec3f> normals_;  // [vertex_count]
};

}  // namespace

std::unique_ptr<SampleMotion> make_gallop(Index vertex_count) { return std::make_unique<Gallop>(vertex_count); }

}  // namespace limber
