// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/walls.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/wall_friction.hpp"

namespace talus::continuum {

namespace {

using Impulses = std::array<Vector3, most_walls>;

Impulses sum(Impulses a, const Impulses& b) {
  for (std::size_t w = 0; w < most_walls; ++w) a[w] += b[w];
  return a;
}

/// The velocity of a particle after friction at a wall.
Vector3 velocity_after_friction(const Parameters& p, const Domain& domain, int wall, const State& state, std::size_t i,
                                const Vector3& position, double normal_acceleration, double duration) {
  const Vector3 n = domain.normal(wall), velocity = state.velocity[i];
  const Vector3 through = dot(velocity, n) * n;
  const Vector3 along = velocity - through;
  if (p.walls.friction == Friction::coulomb)
    return through + sph::coulomb_friction(along, domain.side(wall, position) * normal_acceleration * duration,
                                           p.walls.coefficient);
  if (std::abs(domain.above(wall, position)) > sph::smoothing_length(state.mass, state.density[i]) ||
      !domain.is_beside(wall, position))
    return velocity;
  const SymmetricTensor3<> stress = stress_of(state.material, i);
  const Vector3 traction{stress.xx * n.x + stress.xy * n.y + stress.zx * n.z,
                         stress.xy * n.x + stress.yy * n.y + stress.yz * n.z,
                         stress.zx * n.x + stress.yz * n.y + stress.zz * n.z};
  const double normal = dot(traction, n);
  return through + sph::printed_friction(along, norm(traction - normal * n), normal, p.walls.coefficient, duration);
}

/// Whether a particle that moved so has certainly passed no boundary.
bool stays_inside(const Box& box, const std::vector<Wall>& walls, const Vector3& before, const Vector3& after) {
  return box.contains(after) && std::all_of(walls.begin(), walls.end(), [&](const Wall& wall) {
           return wall.is_above(before) == wall.is_above(after);
         });
}

}  // namespace

bool has_wall_friction(const Parameters& p, const State& state) {
  return p.walls.friction != Friction::none && (p.walls.friction_from == FrictionFrom::start || state.gate_time >= 0);
}

void apply_wall_friction(ThreadTeam& team, const Parameters& p, const Domain& domain, const Rates& rates,
                         std::span<const Vector3> position, double duration, State& state) {
  const bool rough = has_wall_friction(p, state);
  std::array<Vector3, most_walls> normal;
  for (int wall = 0; wall < domain.wall_count(); ++wall) normal[static_cast<std::size_t>(wall)] = domain.normal(wall);
  const auto meet = [&](std::size_t i, Impulses& received) {
    const auto rub = [&](int wall, double normal_acceleration) {
      if (!domain.is_solid(wall)) return;
      const Vector3 after =
          velocity_after_friction(p, domain, wall, state, i, position[i], normal_acceleration, duration);
      received[static_cast<std::size_t>(wall)] += state.mass * (state.velocity[i] - after);
      state.velocity[i] = after;
    };
    rates.by_walls.of(i, [&](int wall, double acceleration) {
      const auto w = static_cast<std::size_t>(wall);
      received[w] -= (state.mass * duration * acceleration) * normal[w];
      if (rough && p.walls.friction == Friction::coulomb && acceleration != 0) rub(wall, acceleration);
    });
    if (rough && p.walls.friction == Friction::printed)
      for (int wall = 0; wall < domain.wall_count(); ++wall) rub(wall, 0);
  };
  state.wall_impulse = sum(state.wall_impulse, accumulate(team, position.size(), Impulses{}, meet, sum));
}

void reflect_at_walls(ThreadTeam& team, const Material& material, const Domain& domain, std::span<const Vector3> before,
                      State& state) {
  constexpr int most_bounces = 8;
  const auto turn = [&](std::size_t i, Impulses& received) {
    const auto become = [&](int wall, const Vector3& position, const Vector3& velocity) {
      received[static_cast<std::size_t>(wall)] += state.mass * (state.velocity[i] - velocity);
      state.velocity[i] = velocity;
      state.position[i] = position;
    };
    if (stays_inside(domain.box(), domain.walls(), before[i], state.position[i])) return;
    for (int bounces = 0;; ++bounces) {
      const auto bounce = domain.bounce(before[i], state.position[i]);
      if (!bounce) break;
      if (bounces == most_bounces) {  // in a narrow corner: back the way it came
        if (!state.reset_position.empty()) state.reset_position[i] += before[i] - state.position[i];
        become(bounce->wall, before[i], -1.0 * state.velocity[i]);
        break;
      }
      const Vector3 place = bounce->image.position(state.position[i]);
      if (!state.reset_position.empty())
        state.reset_position[i] = place - bounce->image.vector(state.position[i] - state.reset_position[i]);
      become(bounce->wall, place, bounce->image.vector(state.velocity[i]));
      material.mirror(state.material, i, bounce->image);
    }
  };
  state.wall_impulse = sum(state.wall_impulse, accumulate(team, before.size(), Impulses{}, turn, sum));
}

}  // namespace talus::continuum
