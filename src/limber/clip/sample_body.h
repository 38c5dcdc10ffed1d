// SPDX-License-Identifier: Apache-2.0
// Creatures as implicit surfaces: tapered limbs, smoothly united. Everything a sample's shape is made of.
#pragma once

#include <span>
#include <vector>

#include "limber/base/vec.h"

namespace limber {

// A limb from `a` to `b` whose radius goes smoothly from radius_a to radius_b; its cross-section is `squash` times
// as thick along the unit vector `flat` as across it. It blends with the limbs before it over the distance `blend`.
struct Limb {
  Vec3d a, b;
  double radius_a = 0.0, radius_b = 0.0;
  Vec3d flat{1.0, 0.0, 0.0};
  double squash = 1.0;
  double blend = 0.0;
  double size = 1.0;  // the edge length wanted on its surface, relative to the rest
};

// What a body is at a point: less than 0 inside, about the distance to the surface near it.
struct BodyValue {
  double distance = 0.0;
  Vec3d gradient;     // of distance
  double size = 1.0;  // the limbs' sizes, blended
};

class Body {
 public:
  // Limbs of no radius are left out.
  explicit Body(std::span<const Limb> limbs);

  BodyValue at(const Vec3d& point) const;

  // The signed distance to limb i (of those not left out) alone.
  double distance_to_limb(std::size_t i, const Vec3d& point) const;
  std::size_t limb_count() const { return limbs_.size(); }

  const Box& bounds() const { return bounds_; }

 private:
  struct Prepared {
    Limb limb;
    Vec3d axis;  // b - a, stretched along `flat`
    double inverse_length2 = 0.0;
    double scale = 1.0;  // makes the value a lower bound of the distance in a squashed limb
    Vec3d center;        // of a ball around the limb
    double radius = 0.0;
  };
  static double evaluate(const Prepared& limb, const Vec3d& point, Vec3d* gradient);

  std::vector<Prepared> limbs_;
  Box bounds_;
};

// A surface that points can be moved onto: a body less a relief, which adds material where it is positive.
class Relief {
 public:
  virtual ~Relief() = default;
  virtual double height(const Vec3d& point) const = 0;
};

struct BodySurface {
  const Body& body;
  const Relief* relief = nullptr;

  double distance(const Vec3d& point) const;
  // The point of the surface that `step_count` Newton steps along the gradient lead to.
  Vec3d project(Vec3d point, int step_count = 6) const;
};

}  // namespace limber
