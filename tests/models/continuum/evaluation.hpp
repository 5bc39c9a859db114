// SPDX-License-Identifier: Apache-2.0
/// A state whose columns a test sets by hand, and the sums over neighbours of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "models/continuum/cases.hpp"
#include "models/continuum/pairs/pair_sums.hpp"

namespace talus::continuum {

/// A state and its pair sums, to be evaluated as it stands.
struct Evaluation {
  ThreadTeam team{2};
  Parameters parameters;
  Material material;
  State state;
  Domain domain;
  PairSums pairs;
  Rates rates;

  explicit Evaluation(const Parameters& p)
      : parameters(p),
        material(p),
        state(initial_state(setup_of(p))),
        domain(Boundary(p).domain()),
        pairs(setup_with(p, 50), domain) {}

  /// Moves every particle at random by up to a share of the spacing.
  void disturb(double share) {
    Random random(3);
    for (Vector3& x : state.position)
      x += share * spacing * Vector3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  }
  void stress(const SymmetricTensor3<>& t) {
    const double component[6] = {t.xx, t.yy, t.zz, t.xy, t.yz, t.zx};
    for (std::size_t c = 0; c < 6; ++c) state.material.stress[c].assign(state.position.size(), component[c]);
  }
  void pressure(double p) { stress({p, p, p, 0, 0, 0}); }
  template <class Field>
  void velocity(Field&& field) {
    for (std::size_t i = 0; i < state.position.size(); ++i) state.velocity[i] = field(state.position[i]);
  }
  /// Densities from a share of the bed's to 1.1 of it, velocities and stresses of any size and sign.
  void randomise(double min_density) {
    Random random(5);
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      state.density[i] *= random.uniform(min_density, 1.1);
      state.velocity[i] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      for (auto& column : state.material.stress) column[i] = random.uniform(-1000, 1000);
    }
  }
  void evaluate(PairTerms terms = PairTerms::all) {
    std::vector<double> h;
    for (std::size_t i = 0; i < state.density.size(); ++i)
      h.push_back(pairs.smoothing_length(state.density[i], state.ratios()[i]));
    pairs.find_neighbours(team, state.position, h);
    pairs(team, {state.position, state.velocity, state.density, h, state.material, state.ratios()}, terms, rates);
  }

  /// Summed over the particles: of all forces, of the walls' alone, and of the sizes of all.
  struct Accelerations {
    Vector3 total, by_walls;
    double size = 0;
  };
  Accelerations accelerations() const {
    Accelerations sums;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      sums.total += rates.acceleration[i];
      sums.size += norm(rates.acceleration[i]);
      rates.by_walls.of(i, [&](int wall, double a) { sums.by_walls[std::min(wall / 2, 2)] += a; });
    }
    return sums;
  }
};

/// A velocity that is linear in space, L x.
inline auto linear(const Tensor3<>& l) {
  return [l](const Vector3& x) {
    return Vector3{l.xx * x.x + l.xy * x.y + l.xz * x.z, l.yx * x.x + l.yy * x.y + l.yz * x.z,
                   l.zx * x.x + l.zy * x.y + l.zz * x.z};
  };
}

/// 1 and -1 from particle to particle of a lattice.
inline double alternating(const Vector3& x) {
  const auto n = [](double place) { return static_cast<int>(std::floor(place / spacing)); };
  return (n(x.x) + n(x.y) + n(x.z)) % 2 == 0 ? 1 : -1;
}

/// A lattice on the floor, at the left and the front face, which are mirrors; its other sides are free. Linear fields
/// that leave the mirrors' planes in place are u_x = a x, u_y = b y, u_z = c z.
inline Parameters block_between_mirrors(double depth) {
  Parameters p = column(6, depth, 6, 4);
  p.box.width *= 2;
  p.box.right = p.box.rear = FaceKind::open;
  p.bed.left = 0;
  p.bed.right = 6 * spacing;
  return p;
}

}  // namespace talus::continuum
