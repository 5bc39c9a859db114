// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/vessel_friction.hpp"

#include <vector>

#include "models/continuum/vessel_motion.hpp"
#include "models/continuum/walls.hpp"
#include "physics/sph/wall_friction.hpp"

namespace talus::continuum {

namespace {

using Impulses = std::vector<Vector3>;  // by patch

/// What fields received, by chunk of particles, each of which one thread goes through in order.
using Noted = std::vector<std::vector<LoadOfField>>;

Noted none_noted(std::size_t particles) {
  return Noted((particles + chunk_size - 1) / chunk_size);
}

void add(const Noted& noted, const SurfaceFields& fields, WallLoads& loads) {
  for (const auto& of_chunk : noted)
    for (const LoadOfField& load : of_chunk) add_load(load, fields, loads);
}

Impulses sum(Impulses a, const Impulses& b) {
  for (std::size_t n = 0; n < a.size(); ++n) a[n] += b[n];
  return a;
}

}  // namespace

void apply_vessel_friction(ThreadTeam& team, const Parameters& p, const SurfaceFields& fields, const Rates& rates,
                           double duration, State& state) {
  if (state.vessel_impulse.empty()) return;
  Noted noted = none_noted(rates.at_vessel.size());
  const bool rough = has_wall_friction(p, state), moving = state.gate_time >= 0;
  const auto meet = [&](std::size_t place, Impulses& received) {
    const std::size_t i = rates.at_vessel[place];
    for (const WallForce& wall : rates.vessel[place].all()) {
      const double push = state.mass * duration * dot(wall.acceleration, wall.normal);
      received[wall.patch] -= (state.mass * duration) * wall.acceleration;
      std::vector<LoadOfField>& of_chunk = noted[place / chunk_size];
      if (of_chunk.empty()) of_chunk.reserve(2 * chunk_size);
      of_chunk.push_back({wall.field, push, -push * wall.normal});
      const double coefficient = p.vessel[wall.patch].friction.value_or(p.walls.coefficient);
      if (!rough) continue;
      // Along the wall in its own frame.
      Vector3 carried;
      if (moving && is_moving(p.vessel[wall.patch])) {
        carried = velocity_of_wall(p, wall.patch, state.position[i]);
        carried -= dot(carried, wall.normal) * wall.normal;
      }
      const Vector3 through = carried + dot(state.velocity[i], wall.normal) * wall.normal;
      const Vector3 along = state.velocity[i] - through;
      const Vector3 after =
          through + sph::coulomb_friction(along, duration * dot(wall.acceleration, wall.normal), coefficient);
      received[wall.patch] += state.mass * (state.velocity[i] - after);
      of_chunk.back().received += state.mass * (state.velocity[i] - after);
      state.velocity[i] = after;
    }
  };
  state.vessel_impulse = sum(
      state.vessel_impulse, accumulate(team, rates.at_vessel.size(), Impulses(state.vessel_impulse.size()), meet, sum));
  add(noted, fields, state.wall_loads);
}

void reflect_at_vessel(ThreadTeam& team, const Surface& vessel, const Neighbourhood& neighbourhood,
                       const SurfaceFields& fields, std::span<const Vector3> before, State& state) {
  if (vessel.is_empty()) return;
  Noted noted = none_noted(before.size());
  constexpr int most_bounces = 4;
  const auto turn = [&](std::size_t i, Impulses& received) {
    Vector3 &x = state.position[i], &u = state.velocity[i];
    if (!neighbourhood.may_meet_vessel(i, before[i], x)) return;
    const Vector3 moved_to = x;
    for (int bounces = 0;; ++bounces) {
      const auto met = vessel.first_crossing(before[i], x);
      if (!met) break;
      const Triangle& triangle = vessel.triangles()[met->triangle];
      const Vector3& normal = vessel.normal(met->triangle);
      const double beyond = dot(normal, x - triangle.corner[0]);  // of the other sign than where it came from
      if (const double speed = dot(u, normal); speed * beyond > 0) {
        const Vector3 impulse = (state.mass * speed) * normal, place = before[i] + met->at * (x - before[i]);
        received[triangle.patch] += impulse;
        noted[i / chunk_size].push_back({fields.at(vessel.part(met->triangle), place), norm(impulse), impulse});
        u -= speed * normal;
      }
      x -= (2 * beyond) * normal;
      if (bounces == most_bounces) x = before[i];  // in a narrow corner: back to where it was
    }
    if (!state.reset_position.empty()) state.reset_position[i] += x - moved_to;
  };
  state.vessel_impulse =
      sum(state.vessel_impulse, accumulate(team, before.size(), Impulses(state.vessel_impulse.size()), turn, sum));
  add(noted, fields, state.wall_loads);
}

}  // namespace talus::continuum
