// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/wall_sums.hpp"

#include <bit>

#include "models/continuum/material.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

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
  const bool silent = local_sound_speed_ && !(trace(stress_of(particles.material, i)) > 0);
  WallForces& forces = rates.vessel[static_cast<std::size_t>(walls_.place_of(i))];
  find_forces_of_walls(walls_, records, i, sums.stress_gradient, constants_, silent ? 0 : constants_.sound_speed,
                       forces);
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
