// SPDX-License-Identifier: Apache-2.0
// The quadruped as a sheet of rubber. A coarse triangulation is dropped once, when the sample is opened; the vertices
// of the clip, however many, are carried by it: each by the coarse vertices around it on its own side of the surface,
// with the affine map that takes the surroundings of such a vertex at rest to where they are now (after Sumner, Schmid
// & Pauly, "Embedded deformation for shape manipulation", 2007, with affine maps instead of near-rotations).
#include <algorithm>
#include <array>
#include <cmath>

#include "limber/clip/sample_cloth.h"
#include "limber/clip/sample_creature.h"
#include "limber/clip/sample_motion.h"
#include "limber/clip/sample_skin.h"
#include "limber/clip/sample_surface.h"

namespace limber {
namespace {

constexpr Index kCoarseCount = 3000;
constexpr double kExtractSpacing = 0.026;
constexpr double kSupport = 1.55;  // of a coarse vertex, in mean edge lengths around it

Vec3d unit(const Vec3d& v) { return v * (1.0 / std::fmax(length(v), 1e-30)); }

std::vector<Vec3d> vertex_normals(const Mesh& mesh, std::span<const Vec3d> positions) {
  std::vector<Vec3d> normals(positions.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d normal = cross(positions[b] - positions[a], positions[c] - positions[a]);
    for (const Index v : {a, b, c}) normals[v] += normal;
  }
  for (Vec3d& normal : normals) normal = unit(normal);
  return normals;
}

Matrix3 add_outer(Matrix3 m, const Vec3d& a, const Vec3d& b) {
  m.rows[0] += b * a.x, m.rows[1] += b * a.y, m.rows[2] += b * a.z;
  return m;
}

Matrix3 inverse_of_symmetric(const Matrix3& m) {
  const Vec3d c0 = cross(m.rows[1], m.rows[2]), c1 = cross(m.rows[2], m.rows[0]), c2 = cross(m.rows[0], m.rows[1]);
  const double scale = 1.0 / dot(m.rows[0], c0);
  Matrix3 inverse;
  inverse.rows = {c0 * scale, c1 * scale, c2 * scale};
  return inverse;
}

class Collapse : public SampleMotion {
 public:
  explicit Collapse(Index vertex_count) {
    const Creature creature = quadruped();
    const Body body(creature.limbs());
    const QuadrupedRelief relief;
    const BodySurface smooth{body}, detailed{body, &relief};
    const SurfaceMesh start = extract_surface(detailed, kExtractSpacing);
    coarse_ = remesh(smooth, start, kCoarseCount);
    fine_ = remesh(detailed, start, vertex_count);
    keys_ = drop_cloth(coarse_, {});
    measure_surroundings();
    bind(body);
  }

  const Mesh& mesh() const override { return fine_.mesh; }

  void pose(std::uint32_t frame, std::uint32_t frame_count, std::span<Vec3f> positions) const override {
    const std::vector<Vec3d> coarse = coarse_at(frame_count > 1 ? static_cast<double>(frame) / (frame_count - 1) : 0.0);
    const std::vector<Matrix3> maps = maps_to(coarse);
    for (std::size_t v = 0; v < positions.size(); ++v) {
      Vec3d sum;
      for (Index i = first_[v]; i < first_[v + 1]; ++i) {
        const Index c = carriers_[i];
        sum += (coarse[c] + maps[c] * (fine_.positions[v] - coarse_.positions[c])) * static_cast<double>(weights_[i]);
      }
      positions[v] = static_cast<Vec3f>(sum);
    }
  }

 private:
  void measure_surroundings() {
    normals_ = vertex_normals(coarse_.mesh, coarse_.positions);
    inverses_.resize(normals_.size());
    supports_.resize(normals_.size());
    std::vector<Matrix3> spreads(normals_.size());
    std::vector<double> counts(normals_.size());
    for (Matrix3& spread : spreads) spread.rows = {};
    for (const Triangle& triangle : coarse_.mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = triangle[i];
        const Vec3d edge = coarse_.positions[triangle[(i + 1) % 3]] - coarse_.positions[a];
        spreads[a] = add_outer(spreads[a], edge, edge);
        supports_[a] += length(edge), counts[a] += 1.0;
      }
    }
    for (std::size_t v = 0; v < normals_.size(); ++v) {
      supports_[v] /= counts[v];
      spreads[v] = add_outer(spreads[v], normals_[v] * (2.0 * supports_[v] * supports_[v]), normals_[v]);
      inverses_[v] = inverse_of_symmetric(spreads[v]);
    }
  }

  // Influences are listed carrier by carrier and then sorted by vertex, so that their order is fixed.
  void bind(const Body& body) {
    struct Influence {
      Index vertex, carrier;
      double weight;
    };
    double widest = 0.0;
    for (const double support : supports_) widest = std::fmax(widest, support * kSupport);
    std::vector<Index> by_height(coarse_.positions.size());
    for (Index c = 0; c < by_height.size(); ++c) by_height[c] = c;
    const auto lower = [&](Index p, Index q) {
      const double a = coarse_.positions[p].z, b = coarse_.positions[q].z;
      return a != b ? a < b : p < q;
    };
    std::sort(by_height.begin(), by_height.end(), lower);
    first_.push_back(0);
    for (const Vec3d& p : fine_.positions) {
      const Vec3d up = unit(body.at(p).gradient);
      auto candidate = std::lower_bound(by_height.begin(), by_height.end(), p.z - widest,
                                        [&](Index c, double z) { return coarse_.positions[c].z < z; });
      const std::size_t begin = weights_.size();
      double sum = 0.0, best_score = 1e30;
      Index best = 0;
      for (; candidate != by_height.end() && coarse_.positions[*candidate].z <= p.z + widest; ++candidate) {
        const double reach = supports_[*candidate] * kSupport;
        const double share = squared_length(p - coarse_.positions[*candidate]) / (reach * reach);
        const double facing = dot(up, normals_[*candidate]);
        if (share * (1.5 - facing) < best_score) best_score = share * (1.5 - facing), best = *candidate;
        if (share >= 1.0 || facing <= 0.0) continue;
        const double weight = (1.0 - share) * (1.0 - share) * facing;
        carriers_.push_back(*candidate);
        weights_.push_back(static_cast<float>(weight));
        sum += weight;
      }
      if (weights_.size() == begin) carriers_.push_back(best), weights_.push_back(1.0f), sum = 1.0;
      for (std::size_t i = begin; i < weights_.size(); ++i) {
        weights_[i] = static_cast<float>(static_cast<double>(weights_[i]) / sum);
      }
      first_.push_back(static_cast<Index>(weights_.size()));
    }
  }

  // Cubic between the keys, which are evenly spaced over `time` from 0 to 1.
  std::vector<Vec3d> coarse_at(double time) const {
    const double place = time * static_cast<double>(keys_.size() - 1);
    const std::size_t key = std::min(static_cast<std::size_t>(place), keys_.size() - 2);
    const double t = place - static_cast<double>(key);
    const std::vector<Vec3f>&a = keys_[key > 0 ? key - 1 : 0], &b = keys_[key], &c = keys_[key + 1],
          &d = keys_[std::min(key + 2, keys_.size() - 1)];
    const std::array<double, 4> w = {0.5 * t * (-1.0 + t * (2.0 - t)), 0.5 * (2.0 + t * t * (-5.0 + 3.0 * t)),
                                     0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)};
    std::vector<Vec3d> positions(b.size());
    for (std::size_t v = 0; v < b.size(); ++v) {
      positions[v] = static_cast<Vec3d>(a[v]) * w[0] + static_cast<Vec3d>(b[v]) * w[1] +
                     static_cast<Vec3d>(c[v]) * w[2] + static_cast<Vec3d>(d[v]) * w[3];
    }
    return positions;
  }

  std::vector<Matrix3> maps_to(const std::vector<Vec3d>& coarse) const {
    const std::vector<Vec3d> normals = vertex_normals(coarse_.mesh, coarse);
    std::vector<Matrix3> maps(coarse.size());
    for (std::size_t v = 0; v < maps.size(); ++v) {
      maps[v].rows = {};
      maps[v] = add_outer(maps[v], normals[v] * (2.0 * supports_[v] * supports_[v]), normals_[v]);
    }
    for (const Triangle& triangle : coarse_.mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = triangle[i], b = triangle[(i + 1) % 3];
        maps[a] = add_outer(maps[a], coarse[b] - coarse[a], coarse_.positions[b] - coarse_.positions[a]);
      }
    }
    for (std::size_t v = 0; v < maps.size(); ++v) {
      // The inverse is symmetric, so its rows are its columns.
      for (Vec3d& row : maps[v].rows) row = inverses_[v] * row;
    }
    return maps;
  }

  SurfaceMesh coarse_, fine_;
  std::vector<std::vector<Vec3f>> keys_;  // of the coarse vertices
  std::vector<Vec3d> normals_;            // [coarse count], at rest
  std::vector<Matrix3> inverses_;         // [coarse count], of the spread of the surroundings at rest
  std::vector<double> supports_;          // [coarse count], mean edge length
  std::vector<Index> first_, carriers_;   // [vertex_count + 1]; [first_.back()]
  std::vector<float> weights_;            // [first_.back()]
};

}  // namespace

std::unique_ptr<SampleMotion> make_collapse(Index vertex_count) { return std::make_unique<Collapse>(vertex_count); }

}  // namespace limber
