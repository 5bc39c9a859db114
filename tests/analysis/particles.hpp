// SPDX-License-Identifier: Apache-2.0
/// Particles of a continuum placed by hand: lattices in a box, with the columns of a snapshot.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/particle_field.hpp"
#include "numerics/snapshot.hpp"

namespace talus::test {

/// A box of width x depth x height from the origin: walls, mirrors front and rear, an open top.
inline Domain box(double width, double depth, double height, std::vector<Wall> walls = {}) {
  return Domain(
      {{0, 0, 0},
       {width, depth, height},
       {FaceKind::wall, FaceKind::wall, FaceKind::symmetry, FaceKind::symmetry, FaceKind::wall, FaceKind::open}},
      std::move(walls));
}

/// A plate over the whole width, at a height, with a slit.
inline Wall plate(double width, double height, double left, double right) {
  return {"plate", {0, 0, height}, {width, 0, height}, {{left, right, true}}};
}

/// The points of a lattice of spacing h that fill the box between two heights, those taken by `is_there(x, z)`.
template <class IsThere>
std::vector<Vector3> lattice(double width, double depth, double from, double to, double h, IsThere&& is_there) {
  std::vector<Vector3> points;
  const auto count = [h](double length) { return static_cast<int>(length / h + 0.5); };
  for (int k = 0; k < count(to - from); ++k)
    for (int j = 0; j < count(depth); ++j)
      for (int i = 0; i < count(width); ++i) {
        const Vector3 x{(i + 0.5) * h, (j + 0.5) * h, from + (k + 0.5) * h};
        if (is_there(x.x, x.z)) points.push_back(x);
      }
  return points;
}
inline std::vector<Vector3> lattice(double width, double depth, double from, double to, double h) {
  return lattice(width, depth, from, to, h, [](double, double) { return true; });
}

/// Particles on a lattice of spacing h, of that packing.
inline Particles particles(const std::vector<Vector3>& position, double h, double packing = 0.6) {
  const double cube = h * h * h;
  return {.position = position,
          .smoothing_length = std::vector<double>(position.size(), h),
          .volume = std::vector<double>(position.size(), cube),
          .solid_volume = packing * cube};
}

/// What a snapshot of the continuum model holds, at rest and without stress.
struct GrainColumns {
  double time = 0;
  std::vector<Vector3> position, velocity;
  std::vector<double> density, packing, shear_rate, stress_xx, stress_yy, stress_zz;
  std::vector<std::int64_t> identity;

  GrainColumns(std::vector<Vector3> places, double bulk_density, double grain_density, double at = 0)
      : time(at), position(std::move(places)) {
    const std::size_t n = position.size();
    velocity.resize(n);
    density.assign(n, bulk_density);
    packing.assign(n, bulk_density / grain_density);
    shear_rate = stress_xx = stress_yy = stress_zz = std::vector<double>(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) identity.push_back(static_cast<std::int64_t>(i));
  }

  Snapshot view() const {
    using V = std::span<const Vector3>;
    using D = std::span<const double>;
    return {.time = time,
            .step = 0,
            .columns = {{"position", "m", V(position)},
                        {"velocity", "m/s", V(velocity)},
                        {"density", "kg/m3", D(density)},
                        {"packing", "1", D(packing)},
                        {"shear_rate", "1/s", D(shear_rate)},
                        {"stress_xx", "Pa", D(stress_xx)},
                        {"stress_yy", "Pa", D(stress_yy)},
                        {"stress_zz", "Pa", D(stress_zz)},
                        {"identity", "1", std::span<const std::int64_t>(identity)}}};
  }
};

}  // namespace talus::test
