// SPDX-License-Identifier: Apache-2.0
// Macklin, Mueller & Chentanez, "XPBD", 2016, with one iteration per small step ("Small steps in physics simulation",
// 2019). Constraints: edges keep their lengths, and so, less strictly, do the diagonals across edges, which resists
// bending; vertices that are far apart at rest keep a distance; nothing goes through the floor.
#include "limber/clip/sample_cloth.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "limber/clip/sample_edges.h"

namespace limber {
namespace {

constexpr double kStretchCompliance = 6e-3, kBendCompliance = 8e-3;
constexpr double kDrag = 0.9;       // per second
constexpr double kFriction = 0.12;  // share of the motion along the floor lost in a step
constexpr int kStepsPerContact = 2;
constexpr double kThickness = 0.72;  // of the mean edge length at a vertex

struct Spring {
  Index a, b;
  double rest, compliance;
};

class Cloth {
 public:
  Cloth(const SurfaceMesh& sheet, const ClothOptions& options)
      : options_(options), rest_(sheet.positions), x_(sheet.positions), before_(sheet.positions), reach_(x_.size()) {
    const EdgeMesh edges(sheet.mesh);
    std::vector<double> sums(x_.size()), counts(x_.size());
    for (Index h = 0; h < edges.half_edge_count(); ++h) {
      const Index g = edges.twin(h);
      sums[edges.from(h)] += length(x_[edges.to(h)] - x_[edges.from(h)]);
      counts[edges.from(h)] += 1.0;
      if (h > g) continue;
      add_spring(edges.from(h), edges.to(h), kStretchCompliance);
      add_spring(edges.from(EdgeMesh::prev(h)), edges.from(EdgeMesh::prev(g)), kBendCompliance);
    }
    for (std::size_t v = 0; v < x_.size(); ++v) {
      reach_[v] = 0.5 * kThickness * sums[v] / counts[v];
      cell_ = std::fmax(cell_, 2.0 * reach_[v]);
    }
  }

  void step(double dt) {
    for (std::size_t v = 0; v < x_.size(); ++v) {
      const Vec3d velocity = (x_[v] - before_[v]) * (1.0 - kDrag * dt);
      before_[v] = x_[v];
      x_[v] += velocity + options_.gravity * (dt * dt);
    }
    for (const Spring& spring : springs_) keep_length(spring, spring.compliance / (dt * dt));
    if (++step_count_ % kStepsPerContact == 0) keep_apart();
    for (std::size_t v = 0; v < x_.size(); ++v) keep_above_floor(v);
  }

  const std::vector<Vec3d>& positions() const { return x_; }

 private:
  void add_spring(Index a, Index b, double compliance) {
    springs_.push_back({a, b, length(x_[b] - x_[a]), compliance});
  }

  void keep_length(const Spring& spring, double softness) {
    const Vec3d way = x_[spring.b] - x_[spring.a];
    const double now = length(way);
    if (now < 1e-12) return;
    // All masses are 1 in units in which the mean vertex has mass 1 / 1000.
    const double w = 1000.0;
    const Vec3d move = way * ((now - spring.rest) * w / (now * (2.0 * w + softness)));
    x_[spring.a] += move;
    x_[spring.b] -= move;
  }

  // Pairs closer than their thickness are moved apart, cell by cell of a grid, in the order of their indices.
  void keep_apart() {
    struct Entry {
      std::uint64_t cell;
      Index vertex;
    };
    std::vector<Entry> entries(x_.size());
    const auto cell_of = [&](const Vec3d& p, int axis_shift_x, int axis_shift_y, int axis_shift_z) {
      const auto part = [&](double c, int shift) {
        return static_cast<std::uint64_t>(
            std::clamp(static_cast<int>(std::floor(c / cell_)) + shift + 50000, 0, 100000));
      };
      return (part(p.x, axis_shift_x) << 40) | (part(p.y, axis_shift_y) << 20) | part(p.z, axis_shift_z);
    };
    for (Index v = 0; v < x_.size(); ++v) entries[v] = {cell_of(x_[v], 0, 0, 0), v};
    std::sort(entries.begin(), entries.end(),
              [](const Entry& p, const Entry& q) { return p.cell != q.cell ? p.cell < q.cell : p.vertex < q.vertex; });
    for (Index v = 0; v < x_.size(); ++v) {
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          // The three cells along z follow each other.
          const std::uint64_t low = cell_of(x_[v], dx, dy, -1), high = cell_of(x_[v], dx, dy, 1);
          auto entry = std::lower_bound(entries.begin(), entries.end(), low,
                                        [](const Entry& e, std::uint64_t cell) { return e.cell < cell; });
          for (; entry != entries.end() && entry->cell <= high; ++entry) {
            if (entry->vertex > v) push_apart(v, entry->vertex);
          }
        }
      }
    }
  }

  void push_apart(Index a, Index b) {
    const double wanted = reach_[a] + reach_[b];
    const Vec3d way = x_[b] - x_[a];
    const double now2 = squared_length(way);
    if (now2 >= wanted * wanted || now2 < 1e-18) return;
    const double rest2 = squared_length(rest_[b] - rest_[a]);
    if (rest2 < 1.44 * wanted * wanted) return;
    const double now = std::sqrt(now2);
    const Vec3d move = way * (0.5 * (wanted - now) / now);
    x_[a] -= move;
    x_[b] += move;
    // What touches sticks a little: the two move on together.
    const Vec3d drift = ((x_[b] - before_[b]) - (x_[a] - before_[a])) * 0.04;
    before_[b] += drift;
    before_[a] -= drift;
  }

  void keep_above_floor(std::size_t v) {
    const double low = options_.floor + 0.3 * reach_[v];
    if (x_[v].y >= low) return;
    x_[v].y = low;
    before_[v].y = low;
    before_[v].x += (x_[v].x - before_[v].x) * kFriction;
    before_[v].z += (x_[v].z - before_[v].z) * kFriction;
  }

  ClothOptions options_;
  std::vector<Vec3d> rest_, x_, before_;  // [vertex_count]
  std::vector<double> reach_;             // [vertex_count], half the thickness
  std::vector<Spring> springs_;
  double cell_ = 0.0;
  int step_count_ = 0;
};

}  // namespace

std::vector<std::vector<Vec3f>> drop_cloth(const SurfaceMesh& sheet, const ClothOptions& options) {
  Cloth cloth(sheet, options);
  std::vector<std::vector<Vec3f>> keys;
  const double dt = options.duration / ((options.key_count - 1) * options.steps_per_key);
  for (int key = 0; key < options.key_count; ++key) {
    std::vector<Vec3f>& positions = keys.emplace_back();
    for (const Vec3d& p : cloth.positions()) positions.push_back(static_cast<Vec3f>(p));
    for (int step = 0; step < options.steps_per_key && key + 1 < options.key_count; ++step) cloth.step(dt);
  }
  return keys;
}

}  // namespace limber
