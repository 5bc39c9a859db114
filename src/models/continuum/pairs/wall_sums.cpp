// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/wall_sums.hpp"

#include <bit>
#include <cmath>

#include "models/continuum/material.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "numerics/sph/velocity_gradient.hpp"
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
  if (!(determinant(whole) > sph::min_moment)) return {};
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

/// Adds the walls to the sums of the velocity's gradient. \param velocity of the particle, m/s
/// \returns what they add to the rate of the density, over the density, 1/s
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

/// Writes the forces of the walls on a particle, in the order in which it meets them. \param records of the pairs
/// \param sums over the particle's neighbours
void find_forces_of_walls(const VesselWalls& walls, const Records& records, std::size_t self, const StressSums& sums,
                          const PairConstants& constants, WallForces& forces) {
  forces.count = 0;
  const NearWalls met = walls.of(self);
  if (met.empty()) return;
  const MotionRecord& own = records.motion[self];
  const double density = 2 * records.stress[self].half_density;
  const SymmetricTensor3<> stress = stress_at(records.stress[self]);
  const std::array<SymmetricTensor3<>, 3> gradient = stress_gradient(records, self, sums);
  const Vector3 velocity{own.velocity[0], own.velocity[1], own.velocity[2]};
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
      const double viscosity = -constants.viscosity_alpha * constants.sound_speed * mu / density;
      a += viscosity * upright;
    }
    forces.of[forces.count++] = {wall.patch, wall.fields, n, (-density * a) * n, 2 * std::abs(upright) / density};
  }
}

}  // namespace

void WallSums::add_gradients(const ParticleView& particles, std::size_t i, ParticleSums& sums) const {
  double *m = sums.moment, *v = sums.velocity;
  sph::GradientSums<> around{{m[0], m[1], m[2], m[3], m[4], m[5]},
                             {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]}};
  sums.density_rate += particles.density[i] * add_walls(walls_.of(i), particles.velocity[i], around);
  const auto& [moment, velocity] = around;
  m[0] = moment.xx, m[1] = moment.yy, m[2] = moment.zz, m[3] = moment.xy, m[4] = moment.yz, m[5] = moment.zx;
  v[0] = velocity.xx, v[1] = velocity.xy, v[2] = velocity.xz;
  v[3] = velocity.yx, v[4] = velocity.yy, v[5] = velocity.yz;
  v[6] = velocity.zx, v[7] = velocity.zy, v[8] = velocity.zz;
}

void WallSums::add_forces(const ParticleView& particles, std::size_t i, const Records& records,
                          const Neighbours& neighbours, ParticleSums& sums, Rates& rates) const {
  const NearWalls met = walls_.of(i);
  WallForces& forces = rates.vessel[static_cast<std::size_t>(walls_.place_of(i))];
  find_forces_of_walls(walls_, records, i, sums.stress_gradient, constants_, forces);
  if (met.empty()) return;
  const std::span<const std::uint32_t> seen(neighbours.record, neighbours.group[neighbours.groups - 1].end);
  Vector3 acceleration;
  double beyond = 0;
  for (const NearWall& wall : met) {
    acceleration += walls_.force_of_images(
        wall, records, i, lists_.neighbourhood().sight_may_change(i) ? &seen : nullptr, constants_.mass);
    beyond += wall.sums.density;
  }
  for (const WallForce& force : forces.all()) acceleration += force.acceleration;
  for (int axis = 0; axis < 3; ++axis) sums.acceleration[axis] += acceleration[axis];
  sums.kernel_density += particles.density[i] * beyond;
  if (lists_.walls()[i] != 0) add_loads(i, records, neighbours, sums);
}

/// Where a wall of the vessel meets a boundary that mirrors, the images in the wall have images behind that boundary.
/// What these push along its normal it bears, as it bears that of any image behind it (WallAccelerations).
void WallSums::add_loads(std::size_t i, const Records& records, const Neighbours& neighbours,
                         ParticleSums& sums) const {
  for (int g = 1; g < neighbours.groups; ++g) {
    const NeighbourGroup &before = neighbours.group[g - 1], &group = neighbours.group[g];
    const auto& loads = lists_.loads_of(group.image);
    if (group.end == before.end || loads[0].wall < 0) continue;
    const std::span<const std::uint32_t> behind(neighbours.record + before.end, group.end - before.end);
    Vector3 acceleration;
    for (const NearWall& wall : walls_.of(i))
      acceleration += walls_.force_of_images(wall, records, i, &behind, constants_.mass);
    for (const Domain::Load& load : loads) {
      if (load.wall < 0) break;
      sums.wall_acceleration[std::popcount(lists_.walls()[i] & ((1u << load.wall) - 1))] +=
          dot(load.part, acceleration);
    }
  }
}

}  // namespace talus::continuum
