// SPDX-License-Identifier: Apache-2.0
// The quadruped turns into the biped. The triangulation is made on the body halfway between, where the features of
// both are there; each vertex then goes with the limbs that carry it, each of which stretches, turns and swells from
// that body to the frame's, and is put back onto the frame's surface.
#include <algorithm>

#include "limber/clip/sample_creature.h"
#include "limber/clip/sample_motion.h"
#include "limber/clip/sample_skin.h"
#include "limber/clip/sample_surface.h"

namespace limber {
namespace {

constexpr double kExtractSpacing = 0.0165;
constexpr double kSoftness = 0.022;
constexpr int kRelaxRounds = 10;

// The map that takes a limb, and the space around it, to another state of the same limb.
class LimbMap {
 public:
  LimbMap(const Limb& from, const Limb& to) : from_(from), to_(to) {
    from_length_ = length(from.b - from.a);
    to_length_ = length(to.b - to.a);
    if (from_length_ > 1e-6) from_way_ = (from.b - from.a) * (1.0 / from_length_);
    to_way_ = to_length_ > 1e-6 ? (to.b - to.a) * (1.0 / to_length_) : from_way_;
    turn_ = rotation_between(from_way_, to_way_);
  }

  Vec3d operator()(const Vec3d& point) const {
    const double swell_a = to_.radius_a / from_.radius_a, swell_b = to_.radius_b / from_.radius_b;
    const Vec3d p = point - from_.a;
    if (!(from_length_ > 1e-6)) return to_.a + turn_ * p * swell_a;
    const double along = dot(p, from_way_);
    const double inner = std::clamp(along, 0.0, from_length_), share = inner / from_length_;
    const double before = std::fmin(along, 0.0), after = std::fmax(along - from_length_, 0.0);
    return to_.a + to_way_ * (before * swell_a + share * to_length_ + after * swell_b) +
           turn_ * (p - from_way_ * along) * (swell_a + (swell_b - swell_a) * share);
  }

 private:
  Limb from_, to_;
  double from_length_ = 0.0, to_length_ = 0.0;
  Vec3d from_way_{0.0, 1.0, 0.0}, to_way_{0.0, 1.0, 0.0};
  Matrix3 turn_;
};

class Morph : public SampleMotion {
 public:
  explicit Morph(Index vertex_count) : limbs_(creature_between(0.5).limbs()) {
    const Body body(limbs_);
    const BodySurface surface{body};
    middle_ = remesh(surface, extract_surface(surface, kExtractSpacing), vertex_count);
    skin_ = skin_weights(body, middle_.positions, kSoftness);
    quadruped_heights_ = heights(0.0, QuadrupedRelief());
    biped_heights_ = heights(1.0, BipedRelief());
  }

  const Mesh& mesh() const override { return middle_.mesh; }

  void pose(std::uint32_t frame, std::uint32_t frame_count, std::span<Vec3f> positions) const override {
    const double time = frame_count > 1 ? static_cast<double>(frame) / (frame_count - 1) : 0.0;
    const double share = time * time * (3.0 - 2.0 * time);
    const std::vector<Limb> limbs = creature_between(share).limbs();
    const Body body(limbs);
    const std::vector<LimbMap> maps = maps_to(limbs);
    const std::vector<Vec3d> places = places_on(body, maps);
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const Vec3d& p = places[v];
      const Vec3d up = body.at(p).gradient;
      const double height =
          static_cast<double>(quadruped_heights_[v]) * (1.0 - share) + static_cast<double>(biped_heights_[v]) * share;
      positions[v] = static_cast<Vec3f>(p + up * (height / std::fmax(squared_length(up), 0.2)));
    }
  }

 private:
  std::vector<LimbMap> maps_to(const std::vector<Limb>& limbs) const {
    std::vector<LimbMap> maps;
    for (std::size_t i = 0; i < limbs.size(); ++i) maps.emplace_back(limbs_[i], limbs[i]);
    return maps;
  }

  std::vector<Vec3d> places_on(const Body& body, const std::vector<LimbMap>& maps) const {
    std::vector<Vec3d> places(middle_.positions.size());
    for (std::size_t v = 0; v < places.size(); ++v) {
      for (Index i = skin_.first[v]; i < skin_.first[v + 1]; ++i) {
        places[v] += maps[skin_.limbs[i]](middle_.positions[v]) * static_cast<double>(skin_.weights[i]);
      }
      places[v] = BodySurface{body}.project(places[v], 3);
    }
    for (int round = 0; round < kRelaxRounds; ++round) relax(body, places);
    return places;
  }

  // Towards the middle of the neighbours, along the surface: opens what the limbs fold together where they meet.
  void relax(const Body& body, std::vector<Vec3d>& places) const {
    std::vector<Vec3d> sums(places.size());
    std::vector<double> counts(places.size());
    for (const Triangle& triangle : middle_.mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        sums[triangle[i]] += places[triangle[(i + 1) % 3]];
        counts[triangle[i]] += 1.0;
      }
    }
    for (std::size_t v = 0; v < places.size(); ++v) {
      places[v] = BodySurface{body}.project(places[v] + (sums[v] * (1.0 / counts[v]) - places[v]) * 0.6, 1);
    }
  }

  std::vector<float> heights(double share, const Relief& relief) const {
    const std::vector<Limb> limbs = creature_between(share).limbs();
    const Body body(limbs);
    const std::vector<LimbMap> maps = maps_to(limbs);
    std::vector<float> result;
    for (const Vec3d& place : places_on(body, maps)) result.push_back(static_cast<float>(relief.height(place)));
    return result;
  }

  std::vector<Limb> limbs_;  // halfway
  SurfaceMesh middle_;
  SkinWeights skin_;
  std::vector<float> quadruped_heights_, biped_heights_;  // [vertex_count]
};

}  // namespace

std::unique_ptr<SampleMotion> make_morph(Index vertex_count) { return std::make_unique<Morph>(vertex_count); }

}  // namespace limber
