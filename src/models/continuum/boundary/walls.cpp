// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/walls.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_sum.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

using Impulses = std::array<FixedVector, most_walls>;

constexpr int max_passes = 4;  // over the walls of a corner

Impulses sum(Impulses a, const Impulses& b) {
  for (std::size_t w = 0; w < most_walls; ++w) a[w] += b[w];
  return a;
}

void add(const Impulses& received, const FixedPoint& point, State& state) {
  for (std::size_t w = 0; w < most_walls; ++w) state.wall_impulse[w] += received[w].value(point);
}

/// The velocity of a particle after the printed friction at a wall.
Vector3 velocity_after_printed_friction(const Parameters& p, const Domain& domain, int wall, const State& state,
                                        std::size_t i, const Vector3& position, double duration) {
  const Vector3 n = domain.normal(wall), velocity = state.velocity[i];
  if (std::abs(domain.above(wall, position)) > sph::smoothing_length(state.mass, state.density[i]) ||
      !domain.is_beside(wall, position))
    return velocity;
  const Vector3 through = dot(velocity, n) * n;
  const SymmetricTensor3<> stress = stress_of(state.material, i);
  const Vector3 traction{stress.xx * n.x + stress.xy * n.y + stress.zx * n.z,
                         stress.xy * n.x + stress.yy * n.y + stress.yz * n.z,
                         stress.zx * n.x + stress.yz * n.y + stress.zz * n.z};
  const double normal = dot(traction, n);
  return through +
         sph::printed_friction(velocity - through, norm(traction - normal * n), normal, p.walls.coefficient, duration);
}

/// How far a particle is from its contact distance of a wall's plane, m. \param side on which the particle is
double gap_of(const Domain& domain, int wall, double side, const Vector3& x, double distance) {
  return side * domain.above(wall, x) - distance;
}

double coefficient_of_walls(const Parameters& p, const State& state) {
  return p.walls.friction == Friction::coulomb && has_wall_friction(p, state) ? p.walls.coefficient : 0;
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

void apply_wall_contact(ThreadTeam& team, const Parameters& p, const Domain& domain, const Rates& rates,
                        std::span<const Vector3> position, const ContactStep& step, State& state) {
  const bool printed = p.walls.friction == Friction::printed && has_wall_friction(p, state);
  const double coefficient = coefficient_of_walls(p, state);
  std::array<Vector3, most_walls> normal;
  for (int wall = 0; wall < domain.wall_count(); ++wall) normal[static_cast<std::size_t>(wall)] = domain.normal(wall);
  const FixedPoint point(state.impulse_unit);
  const auto meet = [&](std::size_t i, Impulses& received) {
    const auto become = [&](int wall, const Vector3& velocity) {
      received[static_cast<std::size_t>(wall)].add(point, state.mass * (state.velocity[i] - velocity));
      state.velocity[i] = velocity;
    };
    const auto touch = [&](int wall, double acceleration) {
      if (!domain.is_solid(wall)) return false;
      const double side = domain.side(wall, position[i]);
      const sph::WallContact contact{
          side * normal[static_cast<std::size_t>(wall)], {}, side * acceleration * step.duration, coefficient};
      const double push = sph::contact_push(dot(state.velocity[i], contact.normal),
                                            gap_of(domain, wall, side, state.position[i], step.distance), step.step);
      const bool touches = push > 0 && domain.is_beside(wall, state.position[i]);
      if (touches || contact.stress_push * coefficient > 0)
        become(wall, sph::after_contact(state.velocity[i], contact, touches ? push : 0));
      return touches;
    };
    bool held = false;
    int walls = 0;
    rates.by_walls.of(i, [&](int wall, double acceleration) {
      const auto w = static_cast<std::size_t>(wall);
      received[w].add(point, (-state.mass * step.duration * acceleration) * normal[w]);
      held = touch(wall, acceleration) || held;
      ++walls;
    });
    // What one wall gave may press on another: in corners.
    for (int pass = 0; held && walls > 1 && pass < max_passes; ++pass) {
      held = false;
      rates.by_walls.of(i, [&](int wall, double) { held = touch(wall, 0) || held; });
    }
    if (printed)
      for (int wall = 0; wall < domain.wall_count(); ++wall)
        if (domain.is_solid(wall))
          become(wall, velocity_after_printed_friction(p, domain, wall, state, i, position[i], step.duration));
  };
  add(accumulate(team, position.size(), Impulses{}, meet, sum), point, state);
}

void hold_off_walls(ThreadTeam& team, const Domain& domain, const Rates& rates, std::span<const Vector3> position,
                    const ContactStep& step, std::span<Vector3> velocity) {
  for_each(team, position.size(), [&](std::size_t i) {
    bool held = true;
    for (int pass = 0; held && pass < max_passes; ++pass) {
      held = false;
      rates.by_walls.of(i, [&](int wall, double) {
        if (!domain.is_solid(wall)) return;
        const double side = domain.side(wall, position[i]);
        const Vector3 n = side * domain.normal(wall);
        const double push =
            sph::contact_push(dot(velocity[i], n), gap_of(domain, wall, side, position[i], step.distance), step.step);
        if (!(push > 0) || !domain.is_beside(wall, position[i])) return;
        velocity[i] += push * n;
        held = true;
      });
    }
  });
}

void reflect_at_walls(ThreadTeam& team, const Parameters& p, const Material& material, const Domain& domain,
                      std::span<const Vector3> before, State& state) {
  constexpr int most_bounces = 8;
  const double coefficient = coefficient_of_walls(p, state);
  const FixedPoint point(state.impulse_unit);
  const auto turn = [&](std::size_t i, Impulses& received) {
    const auto become = [&](int wall, const Vector3& position, const Vector3& velocity) {
      received[static_cast<std::size_t>(wall)].add(point, state.mass * (state.velocity[i] - velocity));
      state.velocity[i] = velocity;
      state.position[i] = position;
    };
    if (stays_inside(domain.box(), domain.walls(), before[i], state.position[i])) return;
    for (int bounces = 0;; ++bounces) {
      const auto bounce = domain.bounce(before[i], state.position[i]);
      if (!bounce) break;
      const bool solid = domain.is_solid(bounce->wall);
      if (bounces == most_bounces) {  // in a narrow corner: back the way it came
        if (!state.reset_position.empty()) state.reset_position[i] += before[i] - state.position[i];
        become(bounce->wall, before[i], solid ? Vector3{} : -1.0 * state.velocity[i]);
        break;
      }
      const Vector3 place = bounce->image.position(state.position[i]);
      if (!state.reset_position.empty())
        state.reset_position[i] = solid ? state.reset_position[i] + (place - state.position[i])
                                        : place - bounce->image.vector(state.position[i] - state.reset_position[i]);
      if (solid) {
        const Vector3 n = domain.side(bounce->wall, before[i]) * domain.normal(bounce->wall);
        become(bounce->wall, place,
               sph::after_contact(state.velocity[i], {n, {}, 0, coefficient},
                                  sph::contact_push(dot(state.velocity[i], n), 0, 1)));
      } else {
        become(bounce->wall, place, bounce->image.vector(state.velocity[i]));
        material.mirror(state.material, i, bounce->image);
      }
    }
  };
  add(accumulate(team, before.size(), Impulses{}, turn, sum), point, state);
}

}  // namespace talus::continuum
