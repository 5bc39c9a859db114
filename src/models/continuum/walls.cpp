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

int axis_of_wall(const Domain& domain, int wall) {
  if (wall < wall_of_plate(0)) return wall / 2;
  const auto plate = static_cast<std::size_t>(wall - wall_of_plate(0));
  return plate < domain.plates().size() ? domain.plates()[plate].axis : 2;
}

struct Wall {
  int number;
  int axis;
  double position;
  int side;  ///< on which lumps are: 1 above, -1 below, 0 both
};

/// The walls that rub: solid faces and plates.
std::vector<Wall> rough_walls(const Domain& domain) {
  std::vector<Wall> walls;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      if (domain.box().face(axis, side) == FaceKind::wall)
        walls.push_back({face_number(axis, side), axis, domain.box().bound(axis, side), side == 0 ? 1 : -1});
  for (int p = 0; p < static_cast<int>(domain.plates().size()); ++p) {
    const Plate& plate = domain.plates()[static_cast<std::size_t>(p)];
    walls.push_back({wall_of_plate(p), plate.axis, plate.position, 0});
  }
  return walls;
}

/// Size of the traction along a plane with that normal.
double shear_on_plane(const SymmetricTensor3<>& t, int axis) {
  return axis == 0 ? std::hypot(t.xy, t.zx) : axis == 1 ? std::hypot(t.xy, t.yz) : std::hypot(t.yz, t.zx);
}

Vector3 rubbed(const Parameters& p, const Wall& wall, const Domain& domain, const Vector3& position,
               const Vector3& velocity, double push, const SymmetricTensor3<>& stress, double mass, double density,
               double duration) {
  Vector3 along = velocity;
  along[wall.axis] = 0;
  const int side = wall.side != 0 ? wall.side : (position[wall.axis] >= wall.position ? 1 : -1);
  if (p.walls.friction == Friction::coulomb) {
    along = sph::coulomb_friction(along, side * push * duration, p.walls.coefficient);
  } else {
    if (std::abs(position[wall.axis] - wall.position) > sph::smoothing_length(mass, density)) return velocity;
    if (wall.number >= wall_of_plate(0) &&
        !domain.plates()[static_cast<std::size_t>(wall.number - wall_of_plate(0))].is_solid(position))
      return velocity;
    const double normal[3] = {stress.xx, stress.yy, stress.zz};
    along = sph::printed_friction(along, shear_on_plane(stress, wall.axis), normal[wall.axis], p.walls.coefficient,
                                  duration);
  }
  along[wall.axis] = velocity[wall.axis];
  return along;
}

}  // namespace

bool is_rough(const Parameters& p, const State& state) {
  return p.walls.friction != Friction::none && (p.walls.friction_from == FrictionFrom::start || state.gate_time >= 0);
}

void meet_walls(ThreadTeam& team, const Parameters& p, const Domain& domain, const Rates& rates,
                std::span<const Vector3> position, double duration, State& state) {
  const std::vector<Wall> rough = is_rough(p, state) ? rough_walls(domain) : std::vector<Wall>{};
  const auto meet = [&](std::size_t i) {
    Impulses received{};
    const std::array<double, most_walls>& push = rates.wall_push[i];
    for (std::size_t wall = 0; wall < most_walls; ++wall)
      received[wall][axis_of_wall(domain, int(wall))] -= state.mass * duration * push[wall];
    for (const Wall& wall : rough) {
      const auto number = static_cast<std::size_t>(wall.number);
      const Vector3 after = rubbed(p, wall, domain, position[i], state.velocity[i], push[number],
                                   stress_of(state.material, i), state.mass, state.density[i], duration);
      received[number] += state.mass * (state.velocity[i] - after);
      state.velocity[i] = after;
    }
    return received;
  };
  state.wall_impulse = sum(state.wall_impulse, reduce(team, position.size(), Impulses{}, meet, sum));
}

void turn_back(ThreadTeam& team, const Material& material, const Domain& domain, std::span<const Vector3> before,
               State& state) {
  constexpr int most_bounces = 8;
  const auto turn = [&](std::size_t i) {
    Impulses received{};
    for (int bounces = 0; bounces < most_bounces; ++bounces) {
      const auto bounce = domain.bounce(before[i], state.position[i]);
      if (!bounce) break;
      const Vector3 after = bounce->image.vector(state.velocity[i]);
      received[static_cast<std::size_t>(bounce->wall)] += state.mass * (state.velocity[i] - after);
      state.velocity[i] = after;
      const Vector3 place = bounce->image.position(state.position[i]);
      if (!state.reset_position.empty())
        state.reset_position[i] = place - bounce->image.vector(state.position[i] - state.reset_position[i]);
      state.position[i] = place;
      material.mirror(state.material, i, bounce->image.vector_sign);
    }
    return received;
  };
  state.wall_impulse = sum(state.wall_impulse, reduce(team, before.size(), Impulses{}, turn, sum));
}

}  // namespace talus::continuum
