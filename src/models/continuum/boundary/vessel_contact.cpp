// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/vessel_contact.hpp"

#include <vector>

#include "base/exact_sum.hpp"
#include "models/continuum/boundary/vessel_motion.hpp"
#include "models/continuum/boundary/walls.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

using Impulses = std::vector<FixedVector>;  // by patch

constexpr int max_contacts = 8;  // of a particle in a step, one after the other: two in a corner, three in its tip

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

void add(const Impulses& received, const FixedPoint& point, State& state) {
  for (std::size_t n = 0; n < received.size(); ++n) state.vessel_impulse[n] += received[n].value(point);
}

/// Walls of the vessel as particles rub on them.
struct Rubbing {
  const Parameters& p;
  const State& s;
  bool rough, moving;

  Rubbing(const Parameters& parameters, const State& state)
      : p(parameters), s(state), rough(has_wall_friction(parameters, state)), moving(state.gate_time >= 0) {}

  double coefficient(std::uint32_t patch) const {
    return rough ? p.vessel[patch].friction.value_or(p.walls.coefficient) : 0;
  }
  /// Along the wall, m/s.
  Vector3 velocity_of(std::uint32_t patch, const Vector3& place, const Vector3& normal) const {
    if (!moving || !is_moving(p.vessel[patch])) return {};
    const Vector3 carried = velocity_of_wall(p, patch, place);
    return carried - dot(carried, normal) * normal;
  }
};

}  // namespace

void apply_vessel_contact(ThreadTeam& team, const Parameters& p, const SurfaceFields& fields, const Rates& rates,
                          const ContactStep& step, PairSums& pairs, State& state) {
  if (state.vessel_impulse.empty()) return;
  Noted noted = none_noted(rates.at_vessel.size());
  const Rubbing rubbing(p, state);
  VesselWalls& walls = pairs.vessel_walls();
  const FixedPoint point(state.impulse_unit);
  const auto meet = [&](std::size_t place, Impulses& received) {
    const std::size_t i = rates.at_vessel[place];
    const Vector3& x = state.position[i];
    std::vector<LoadOfField>& of_chunk = noted[place / chunk_size];
    if (of_chunk.empty()) of_chunk.reserve(2 * chunk_size);
    const auto become = [&](std::uint32_t patch, const Vector3& velocity) {
      const Vector3 impulse = state.mass * (state.velocity[i] - velocity);
      received[patch].add(point, impulse);
      of_chunk.back().received += impulse;
      state.velocity[i] = velocity;
    };
    for (const WallForce& wall : rates.vessel[place].all()) {
      const double push = state.mass * step.duration * dot(wall.acceleration, wall.normal);
      received[wall.patch].add(point, (-state.mass * step.duration) * wall.acceleration);
      of_chunk.push_back({wall.field, push, -push * wall.normal});
      if (!rubbing.rough) continue;
      become(wall.patch,
             sph::after_contact(state.velocity[i],
                                {wall.normal, rubbing.velocity_of(wall.patch, x, wall.normal),
                                 step.duration * dot(wall.acceleration, wall.normal), rubbing.coefficient(wall.patch)},
                                0));
    }
    for (int contact = 0; contact < max_contacts; ++contact) {
      const auto touched = walls.touched(place, x, x + step.step * state.velocity[i], step.distance);
      if (!touched) break;
      const Vector3& n = touched->normal;
      const std::uint32_t patch = walls.surface().triangles()[touched->triangle].patch;
      const double push =
          sph::contact_push(dot(state.velocity[i], n), dot(n, x - touched->place) - step.distance, step.step);
      if (!(push > 0)) break;
      of_chunk.push_back({fields.at(walls.surface().part(touched->triangle), touched->place), state.mass * push, {}});
      become(patch, sph::after_contact(
                        state.velocity[i],
                        {n, rubbing.velocity_of(patch, touched->place, n), 0, rubbing.coefficient(patch)}, push));
    }
  };
  add(accumulate(team, rates.at_vessel.size(), Impulses(state.vessel_impulse.size()), meet, sum), point, state);
  add(noted, fields, state.wall_loads);
}

void hold_off_vessel(ThreadTeam& team, const Rates& rates, std::span<const Vector3> position, const ContactStep& step,
                     PairSums& pairs, std::span<Vector3> velocity) {
  VesselWalls& walls = pairs.vessel_walls();
  for_each(team, rates.at_vessel.size(), [&](std::size_t place) {
    const std::size_t i = rates.at_vessel[place];
    for (int contact = 0; contact < max_contacts; ++contact) {
      const auto touched = walls.touched(place, position[i], position[i] + step.step * velocity[i], step.distance);
      if (!touched) break;
      const double push =
          sph::contact_push(dot(velocity[i], touched->normal),
                            dot(touched->normal, position[i] - touched->place) - step.distance, step.step);
      if (!(push > 0)) break;
      velocity[i] += push * touched->normal;
    }
  });
}

void reflect_at_vessel(ThreadTeam& team, const Parameters& p, const Surface& vessel, const Neighbourhood& neighbourhood,
                       const SurfaceFields& fields, std::span<const Vector3> before, State& state) {
  if (vessel.is_empty()) return;
  Noted noted = none_noted(before.size());
  const Rubbing rubbing(p, state);
  constexpr int most_bounces = 4;
  const FixedPoint point(state.impulse_unit);
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
      const Vector3 n = beyond > 0 ? -1.0 * normal : normal, place = before[i] + met->at * (x - before[i]);
      if (const double push = sph::contact_push(dot(u, n), 0, 1); push > 0) {
        const Vector3 after = sph::after_contact(
            u, {n, rubbing.velocity_of(triangle.patch, place, n), 0, rubbing.coefficient(triangle.patch)}, push);
        const Vector3 impulse = state.mass * (u - after);
        received[triangle.patch].add(point, impulse);
        noted[i / chunk_size].push_back({fields.at(vessel.part(met->triangle), place), state.mass * push, impulse});
        u = after;
      }
      x -= (2 * beyond) * normal;
      if (bounces == most_bounces) x = before[i];  // in a narrow corner: back to where it was
    }
    if (!state.reset_position.empty()) state.reset_position[i] += x - moved_to;
  };
  add(accumulate(team, before.size(), Impulses(state.vessel_impulse.size()), turn, sum), point, state);
  add(noted, fields, state.wall_loads);
}

}  // namespace talus::continuum
