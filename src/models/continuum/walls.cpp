// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/walls.hpp"

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

struct Wall {
  int number;
  Vector3 place, normal;
  int side;  ///< on which particles are: 1 above, -1 below, 0 both
};

/// The walls that rub: solid faces, plates, panels.
std::vector<Wall> rough_walls(const Domain& domain) {
  std::vector<Wall> walls;
  const auto add = [&](int number, const Vector3& place, int side) {
    walls.push_back({number, place, domain.normal(number), side});
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      if (domain.box().face(axis, side) == FaceKind::wall)
        add(face_number(axis, side), side == 0 ? domain.box().low : domain.box().high, side == 0 ? 1 : -1);
  for (int p = 0; p < static_cast<int>(domain.plates().size()); ++p) {
    const Plate& plate = domain.plates()[static_cast<std::size_t>(p)];
    Vector3 place;
    place[plate.axis] = plate.position;
    add(wall_of_plate(p), place, 0);
  }
  for (int p = 0; p < static_cast<int>(domain.panels().size()); ++p)
    add(wall_of_plate(p), domain.panels()[static_cast<std::size_t>(p)].from, 0);
  return walls;
}

/// Whether the wall is there, at a place beside it: no opening of a plate, no end of a panel.
bool is_beside(const Domain& domain, const Wall& wall, const Vector3& position) {
  if (wall.number < wall_of_plate(0)) return true;
  const auto number = static_cast<std::size_t>(wall.number - wall_of_plate(0));
  if (!domain.plates().empty()) return domain.plates()[number].is_solid(position);
  const Panel& panel = domain.panels()[number];
  return panel.is_solid(dot(panel.along(), position - panel.from));
}

Vector3 rubbed(const Parameters& p, const Wall& wall, const Domain& domain, const Vector3& position,
               const Vector3& velocity, double push, const SymmetricTensor3<>& stress, double mass, double density,
               double duration) {
  const Vector3 through = dot(velocity, wall.normal) * wall.normal;
  const Vector3 along = velocity - through;
  const double above = dot(position - wall.place, wall.normal);
  if (p.walls.friction == Friction::coulomb) {
    const int side = wall.side != 0 ? wall.side : (above >= 0 ? 1 : -1);
    return through + sph::coulomb_friction(along, side * push * duration, p.walls.coefficient);
  }
  if (std::abs(above) > sph::smoothing_length(mass, density) || !is_beside(domain, wall, position)) return velocity;
  const Vector3 n = wall.normal;
  const Vector3 traction{stress.xx * n.x + stress.xy * n.y + stress.zx * n.z,
                         stress.xy * n.x + stress.yy * n.y + stress.yz * n.z,
                         stress.zx * n.x + stress.yz * n.y + stress.zz * n.z};
  const double normal = dot(traction, n);
  return through + sph::printed_friction(along, norm(traction - normal * n), normal, p.walls.coefficient, duration);
}

}  // namespace

bool is_rough(const Parameters& p, const State& state) {
  return p.walls.friction != Friction::none && (p.walls.friction_from == FrictionFrom::start || state.gate_time >= 0);
}

void meet_walls(ThreadTeam& team, const Parameters& p, const Domain& domain, const Rates& rates,
                std::span<const Vector3> position, double duration, State& state) {
  const std::vector<Wall> rough = is_rough(p, state) ? rough_walls(domain) : std::vector<Wall>{};
  const std::size_t walls = 6 + domain.plates().size() + domain.panels().size();
  const auto meet = [&](std::size_t i, Impulses& received) {
    const std::array<double, most_walls>& push = rates.wall_push[i];
    for (std::size_t wall = 0; wall < walls; ++wall)
      if (push[wall] != 0) received[wall] -= (state.mass * duration * push[wall]) * domain.normal(int(wall));
    for (const Wall& wall : rough) {
      const auto number = static_cast<std::size_t>(wall.number);
      if (p.walls.friction == Friction::coulomb && push[number] == 0) continue;
      const Vector3 after = rubbed(p, wall, domain, position[i], state.velocity[i], push[number],
                                   stress_of(state.material, i), state.mass, state.density[i], duration);
      received[number] += state.mass * (state.velocity[i] - after);
      state.velocity[i] = after;
    }
  };
  state.wall_impulse = sum(state.wall_impulse, accumulate(team, position.size(), Impulses{}, meet, sum));
}

void turn_back(ThreadTeam& team, const Material& material, const Domain& domain, std::span<const Vector3> before,
               State& state) {
  constexpr int most_bounces = 8;
  const auto turn = [&](std::size_t i, Impulses& received) {
    const auto become = [&](int wall, const Vector3& position, const Vector3& velocity) {
      received[static_cast<std::size_t>(wall)] += state.mass * (state.velocity[i] - velocity);
      state.velocity[i] = velocity;
      state.position[i] = position;
    };
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
