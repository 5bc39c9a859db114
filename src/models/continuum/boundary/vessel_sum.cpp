// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/vessel_sum.hpp"

#include <cmath>

#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/pair_terms.hpp"

namespace talus::continuum {

namespace {

Vector3 times(const SymmetricTensor3<>& t, const Vector3& v) {
  return {t.xx * v.x + t.xy * v.y + t.zx * v.z, t.xy * v.x + t.yy * v.y + t.yz * v.z,
          t.zx * v.x + t.yz * v.y + t.zz * v.z};
}

/// As a mirror with that normal shows it.
Vector3 mirrored(const Vector3& v, const Vector3& n) {
  return v - (2 * dot(v, n)) * n;
}

SymmetricTensor3<> stress_at(const StressRecord& record) {
  const double* s = record.specific_stress;
  return {s[0], s[1], s[2], s[3], s[4], s[5]};
}

/// What turns the sum over a field that goes on linearly along the normal, times that slope, into that over the field
/// mirrored: 2 (d - s cos) along the ray, d the distance from the wall, in place of 0.
Vector3 evened(const NearWall& wall) {
  return -2.0 * times(wall.moment(), wall.normal) - (2 * wall.distance) * wall.slope();
}

/// Gradient of the specific stress along x, y and z from the neighbours alone, exact for a linear field; none where
/// they do not span the space. It is made smaller where the pressure would be gone within a smoothing length: grains
/// that hardly bear any have none beyond the wall.
std::array<SymmetricTensor3<>, 3> stress_gradient(const Records& records, std::size_t self, const StressSums& sums) {
  const MotionRecord& own = records.motion[self];
  const double pressure = trace(stress_at(records.stress[self]));
  if (!(pressure > 0)) return {};
  const double* m = sums.moment;
  const SymmetricTensor3<> moment{m[0], m[1], m[2], m[3], m[4], m[5]};
  const Tensor3<> whole = full(moment);
  if (!(determinant(whole) > sph::least_moment)) return {};
  const Tensor3<> inverted = inverse(whole);
  double gradient[6][3];
  for (int c = 0; c < 6; ++c) {
    const double* a = sums.along[c];
    gradient[c][0] = inverted.xx * a[0] + inverted.xy * a[1] + inverted.xz * a[2];
    gradient[c][1] = inverted.yx * a[0] + inverted.yy * a[1] + inverted.yz * a[2];
    gradient[c][2] = inverted.zx * a[0] + inverted.zy * a[1] + inverted.zz * a[2];
  }
  std::array<SymmetricTensor3<>, 3> result;
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = {gradient[0][k], gradient[1][k], gradient[2][k], gradient[3][k], gradient[4][k], gradient[5][k]};
  const double fall = 2 * own.half_length *
                      std::sqrt(trace(result[0]) * trace(result[0]) + trace(result[1]) * trace(result[1]) +
                                trace(result[2]) * trace(result[2]));
  if (fall > pressure)
    for (auto& component : result) component = (pressure / fall) * component;
  return result;
}

}  // namespace

double add_walls(NearWalls met, const Vector3& velocity, sph::GradientSums<>& sums) {
  if (met.empty()) return 0;
  const Tensor3<> inside = sph::velocity_gradient(sums);
  double opening = 0;
  for (const NearWall& wall : met) {
    const Vector3& n = wall.normal;
    const SymmetricTensor3<> m = wall.moment();
    // P L, P = 1 - n n
    const Vector3 across{n.x * inside.xx + n.y * inside.yx + n.z * inside.zx,
                         n.x * inside.xy + n.y * inside.yy + n.z * inside.zy,
                         n.x * inside.xz + n.y * inside.yz + n.z * inside.zz};
    const Tensor3<> l{inside.xx - n.x * across.x, inside.xy - n.x * across.y, inside.xz - n.x * across.z,
                      inside.yx - n.y * across.x, inside.yy - n.y * across.y, inside.yz - n.y * across.z,
                      inside.zx - n.z * across.x, inside.zy - n.z * across.y, inside.zz - n.z * across.z};
    // What changes along the normal is the same on both sides of the wall, at the distance that it has from it.
    const Vector3 shear{l.xx * n.x + l.xy * n.y + l.xz * n.z, l.yx * n.x + l.yy * n.y + l.yz * n.z,
                        l.zx * n.x + l.zy * n.y + l.zz * n.z};
    const Vector3 f = evened(wall);
    const Tensor3<> slipping =
        l * full(m) + Tensor3<>{shear.x * f.x, shear.x * f.y, shear.x * f.z, shear.y * f.x, shear.y * f.y,
                                shear.y * f.z, shear.z * f.x, shear.z * f.y, shear.z * f.z};
    const Vector3 u = -dot(velocity, n) * n, b = wall.closing();
    const Tensor3<> added{slipping.xx + u.x * b.x, slipping.xy + u.x * b.y, slipping.xz + u.x * b.z,
                          slipping.yx + u.y * b.x, slipping.yy + u.y * b.y, slipping.yz + u.y * b.z,
                          slipping.zx + u.z * b.x, slipping.zy + u.z * b.y, slipping.zz + u.z * b.z};
    sums.moment = sums.moment + m;
    sums.velocity = sums.velocity + added;
    opening += trace(added);
  }
  return -opening;
}

void find_forces_of_walls(const VesselWalls& walls, const Records& records, std::size_t self, const StressSums& sums,
                          const PairConstants& constants, double sound_speed, WallForces& forces) {
  forces.count = 0;
  const NearWalls met = walls.of(self);
  if (met.empty()) return;
  const MotionRecord& own = records.motion[self];
  const double density = 2 * records.stress[self].half_density;
  const SymmetricTensor3<> stress = stress_at(records.stress[self]);
  const std::array<SymmetricTensor3<>, 3> gradient = stress_gradient(records, self, sums);
  const Vector3 velocity{own.velocity[0], own.velocity[1], own.velocity[2]};
  const sph::ArtificialViscosity viscous{constants.viscosity_alpha, constants.viscosity_beta};
  for (const NearWall& wall : met) {
    const Vector3& n = wall.normal;
    const SymmetricTensor3<> m = wall.moment();
    // Along n, with R t R for a tensor t that a mirror shows and R n = -n: of (stress + R stress R) slope and of
    // R gradient R moment.
    const double upright = dot(wall.slope(), n);
    double a = 2 * upright * dot(times(stress, n), n);
    a -= dot(times(gradient[0], n), mirrored({m.xx, m.xy, m.zx}, n));
    a -= dot(times(gradient[1], n), mirrored({m.xy, m.yy, m.yz}, n));
    a -= dot(times(gradient[2], n), mirrored({m.zx, m.yz, m.zz}, n));
    // The image of the particle itself is met at twice the speed and twice the distance.
    const double approach = dot(velocity, n);
    const double mu = 2 * own.half_length * approach * wall.sums.nearness / wall.sums.weight;
    if (mu < 0) {
      const double viscosity = (viscous.beta * mu - viscous.alpha * sound_speed) * mu / density;
      a += viscosity * upright;
    }
    forces.of[forces.count++] = {wall.patch, wall.field, n, (-density * a) * n};
  }
}

}  // namespace talus::continuum
