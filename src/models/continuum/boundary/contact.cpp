// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/contact.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/elementary.hpp"
#include "base/exact_sum.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

constexpr int max_passes = 4;    // over the planes of a corner
constexpr int max_contacts = 8;  // with the vessel, one after the other: two in a corner, three in its tip

bool has_friction(const Parameters& p, const State& state) {
  return p.walls.friction != Friction::none && (p.walls.friction_from == FrictionFrom::start || state.gate_time >= 0);
}

/// At which walls hold a particle, m.
double contact_distance(const ContactSetting& setting, const State& state, std::size_t particle) {
  return state.mass_ratio.empty() ? setting.distance
                                  : cube_root(size_ratio(state.mass_ratio[particle])) * setting.distance;
}

/// What patches receive in a step, and what fields of the vessel note, by chunk of particles. Sums in fixed point do
/// not depend on the order.
class Loads {
 public:
  using Impulses = std::vector<FixedVector>;  // by patch

  Loads(const ContactSetting& setting, State& state)
      : fields_(setting.fields),
        share_(setting.share),
        point_(state.impulse_unit),
        state_(state),
        noted_(setting.boundary.vessel().is_empty() ? 0 : (state.position.size() + chunk_size - 1) / chunk_size) {}

  /// \param impulse N s
  void receive(Impulses& received, std::size_t patch, const Vector3& impulse) const {
    received[patch].add(point_, impulse);
  }
  void note(std::size_t particle, const LoadOfFields& load) {
    std::vector<LoadOfFields>& of_chunk = noted_[particle / chunk_size];
    if (of_chunk.empty()) of_chunk.reserve(2 * chunk_size);
    of_chunk.push_back(load);
  }

  /// Calls meet(i, received) for the particles that this process owns and adds what walls received to the state: what
  /// patches did from those of all processes, what fields did from its own.
  template <class Meet>
  void collect(ThreadTeam& team, Meet&& meet) {
    const Impulses here = accumulate(
        team, state_.position.size(), Impulses(state_.patch_impulse.size()),
        [&](std::size_t i, Impulses& received) {
          if (share_.owns(i)) meet(i, received);
        },
        [](Impulses a, const Impulses& b) {
          for (std::size_t n = 0; n < a.size(); ++n) a[n] += b[n];
          return a;
        });
    share_.add_later(here, [point = point_, &impulse = state_.patch_impulse](std::span<const FixedVector> all) {
      for (std::size_t n = 0; n < all.size(); ++n) impulse[n] += all[n].value(point);
    });
    for (const auto& of_chunk : noted_)
      for (const LoadOfFields& load : of_chunk) add_load(load, fields_, state_.wall_loads);
  }

 private:
  const SurfaceFields& fields_;
  Share& share_;
  FixedPoint point_;
  State& state_;
  std::vector<std::vector<LoadOfFields>> noted_;
};

/// The walls as they rub at present.
struct Walls {
  const Boundary& boundary;
  bool rough, moving, pulled;  // pulled: whether grains may pull at them

  Walls(const ContactSetting& setting, const State& state)
      : boundary(setting.boundary),
        rough(has_friction(setting.parameters, state)),
        moving(state.gate_time >= 0),
        pulled(has_cohesion(setting.parameters)) {}

  /// \param normal towards the particle \param x of the wall \param push_per_stress impulse over mass that a stress of
  /// the wall gives the particle in the step, m/(s Pa)
  sph::WallContact contact(std::size_t patch, const Vector3& x, const Vector3& normal, double stress_push,
                           double push_per_stress = 0) const {
    const Patch& wall = boundary.patches()[patch];
    Vector3 along;
    if (moving && wall.motion) {
      along = wall.motion->at(x);
      along = along - dot(along, normal) * normal;
    }
    if (!pulled) return {normal, along, stress_push, rough ? wall.friction : 0};
    const double adhesion = wall.adhesion * push_per_stress;
    return {normal,
            along,
            stress_push,
            rough ? wall.friction : 0,
            rough ? adhesion : 0,
            sph::parting(stress_push, adhesion, wall.friction)};
  }
};

/// Planes near a particle that act by images.
class Planes {
 public:
  explicit Planes(const ContactSetting& setting) : domain_(setting.boundary.domain()) {
    for (int wall = 0; wall < domain_.wall_count(); ++wall) normal_.push_back(domain_.normal(wall));
  }
  const Vector3& normal(int wall) const { return normal_[static_cast<std::size_t>(wall)]; }
  /// The side of a plane on which x is, 1 or -1.
  double side(int wall, const Vector3& x) const { return domain_.side(wall, x); }
  /// What the plane adds to a velocity along its normal, which points to that side; 0 where there is no wall, m/s.
  /// \param distance at which it holds the particle, m
  double push(int wall, double side, const Vector3& x, const Vector3& velocity, double step, double distance) const {
    const double gap = side * domain_.above(wall, x) - distance;
    const double push = sph::contact_push(dot(velocity, side * normal(wall)), gap, step);
    return push > 0 && domain_.is_beside(wall, x) ? push : 0;
  }

 private:
  const Domain& domain_;
  std::vector<Vector3> normal_;
};

/// Calls hold(touch, push) for what a particle at x touches of the vessel within a step, until nothing is left. hold()
/// adds the push to the velocity.
template <class Hold>
void for_each_contact(VesselWalls& walls, std::int32_t slot, const Vector3& x, const Vector3& velocity, double step,
                      double distance, Hold&& hold) {
  for (int contact = 0; contact < max_contacts; ++contact) {
    const auto touched = walls.touched(static_cast<std::size_t>(slot), x, x + step * velocity, distance);
    if (!touched) return;
    const Vector3& n = touched->normal;
    const double push = sph::contact_push(dot(velocity, n), dot(n, x - touched->place) - distance, step);
    if (!(push > 0)) return;
    hold(*touched, push);
  }
}

/// Of the particle among those that may meet the vessel; -1: it does not.
std::int32_t slot_of(const VesselWalls& walls, std::size_t particle) {
  return walls.is_empty() ? -1 : walls.place_of(particle);
}

/// The velocity of a particle after the printed friction at a wall.
Vector3 velocity_after_printed_friction(const Parameters& p, const Domain& domain, int wall, const State& state,
                                        std::size_t i, const Vector3& position, double duration) {
  const Vector3 n = domain.normal(wall), velocity = state.velocity[i];
  if (std::abs(domain.above(wall, position)) > sph::smoothing_length(state.mass_of_size(i), state.density[i]) ||
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

/// Whether a particle that moved so has certainly passed no boundary of the domain.
bool stays_inside(const Domain& domain, const Vector3& before, const Vector3& after) {
  return domain.box().contains(after) &&
         std::all_of(domain.walls().begin(), domain.walls().end(),
                     [&](const Wall& wall) { return wall.is_above(before) == wall.is_above(after); });
}

}  // namespace

void apply_contact(ThreadTeam& team, const ContactSetting& setting, const Rates& rates,
                   std::span<const Vector3> position, const ContactStep& step, PairSums& pairs, State& state) {
  const Domain& domain = setting.boundary.domain();
  const Walls walls(setting, state);
  const Planes planes(setting);
  VesselWalls& vessel = pairs.vessel_walls();
  const bool printed = setting.parameters.walls.friction == Friction::printed && walls.rough;
  Loads loads(setting, state);
  loads.collect(team, [&](std::size_t i, Loads::Impulses& received) {
    const Vector3& x = state.position[i];
    Vector3& velocity = state.velocity[i];
    const double mass = state.mass_of(i), distance = contact_distance(setting, state, i);
    const auto become = [&](std::size_t patch, const Vector3& after) {
      const Vector3 impulse = mass * (velocity - after);
      loads.receive(received, patch, impulse);
      velocity = after;
      return impulse;
    };
    const auto touch = [&](int wall, double acceleration, double duration) {
      if (!domain.is_solid(wall)) return false;
      const auto patch = static_cast<std::size_t>(wall);
      const double side = planes.side(wall, position[i]);
      double per_stress = 0;
      if (walls.pulled) {
        const double h = pairs.smoothing_length(state.density[i], mass / state.mass);
        per_stress =
            2 * duration / state.density[i] * sph::cubic_spline_plane(side * domain.above(wall, position[i]), h);
      }
      const sph::WallContact contact =
          walls.contact(patch, x, side * planes.normal(wall), side * acceleration * duration, per_stress);
      const double push = planes.push(wall, side, x, velocity, step.step, distance);
      if (push > 0 || contact.stress_push * contact.coefficient > 0 || contact.adhesion > 0 || contact.parting > 0)
        become(patch, sph::after_contact(velocity, contact, push));
      return push > 0;
    };
    bool held = false;
    int count = 0;
    rates.by_walls.of(i, [&](int wall, double acceleration) {
      loads.receive(received, static_cast<std::size_t>(wall),
                    (-mass * step.duration * acceleration) * planes.normal(wall));
      held = touch(wall, acceleration, step.duration) || held;
      ++count;
    });
    // What one wall gave may press on another: in corners.
    for (int pass = 0; held && count > 1 && pass < max_passes; ++pass) {
      held = false;
      rates.by_walls.of(i, [&](int wall, double) { held = touch(wall, 0, 0) || held; });
    }
    if (printed)
      for (int wall = 0; wall < domain.wall_count(); ++wall)
        if (domain.is_solid(wall))
          become(static_cast<std::size_t>(wall), velocity_after_printed_friction(setting.parameters, domain, wall,
                                                                                 state, i, position[i], step.duration));

    const std::int32_t slot = slot_of(vessel, i);
    if (slot < 0) return;
    for (const WallForce& wall : rates.vessel[static_cast<std::size_t>(slot)].all()) {
      const std::size_t patch = setting.boundary.patch_of_part(wall.patch);
      const double pushed = mass * step.duration * dot(wall.acceleration, wall.normal);
      loads.receive(received, patch, (-mass * step.duration) * wall.acceleration);
      LoadOfFields load{wall.fields, pushed, -pushed * wall.normal};
      const sph::WallContact contact = walls.contact(
          patch, x, wall.normal, step.duration * dot(wall.acceleration, wall.normal), step.duration * wall.per_stress);
      if (walls.rough || contact.parting > 0) load.received += become(patch, sph::after_contact(velocity, contact, 0));
      load.push += mass * contact.parting;  // what the wall does not hold does not pull at it
      loads.note(i, load);
    }
    for_each_contact(
        vessel, slot, x, velocity, step.step, distance, [&](const VesselWalls::Touch& touched, double push) {
          const Surface& surface = vessel.surface();
          const std::size_t patch = setting.boundary.patch_of_part(surface.triangles()[touched.triangle].patch);
          const FieldShare fields = setting.fields.under(surface.part(touched.triangle), touched.place);
          const sph::WallContact contact = walls.contact(patch, touched.place, touched.normal, 0);
          loads.note(i, {fields, mass * push, become(patch, sph::after_contact(velocity, contact, push))});
        });
  });
}

void prevent_approach(ThreadTeam& team, const ContactSetting& setting, const Rates& rates, const State& state,
                      double step, PairSums& pairs, std::span<Vector3> velocity) {
  const Domain& domain = setting.boundary.domain();
  const Planes planes(setting);
  VesselWalls& vessel = pairs.vessel_walls();
  for_each(team, state.position.size(), [&](std::size_t i) {
    const Vector3& x = state.position[i];
    const double distance = contact_distance(setting, state, i);
    bool held = true;
    for (int pass = 0; held && pass < max_passes; ++pass) {
      held = false;
      rates.by_walls.of(i, [&](int wall, double) {
        if (!domain.is_solid(wall)) return;
        const double side = planes.side(wall, x), push = planes.push(wall, side, x, velocity[i], step, distance);
        velocity[i] += push * (side * planes.normal(wall));
        held = held || push > 0;
      });
    }
    if (const std::int32_t slot = slot_of(vessel, i); slot >= 0)
      for_each_contact(vessel, slot, x, velocity[i], step, distance,
                       [&](const VesselWalls::Touch& touched, double push) { velocity[i] += push * touched.normal; });
  });
}

void reflect(ThreadTeam& team, const ContactSetting& setting, const Material& material,
             const Neighbourhood& neighbourhood, std::span<const Vector3> before, State& state) {
  constexpr int max_bounces = 8, max_bounces_in_vessel = 4;
  const Domain& domain = setting.boundary.domain();
  const Surface& vessel = setting.boundary.vessel();
  const Walls walls(setting, state);
  Loads loads(setting, state);
  const auto at_planes = [&](std::size_t i, Loads::Impulses& received) {
    const double mass = state.mass_of(i);
    const auto become = [&](int wall, const Vector3& position, const Vector3& velocity) {
      loads.receive(received, static_cast<std::size_t>(wall), mass * (state.velocity[i] - velocity));
      state.velocity[i] = velocity;
      state.position[i] = position;
    };
    for (int bounces = 0;; ++bounces) {
      const auto bounce = domain.bounce(before[i], state.position[i]);
      if (!bounce) break;
      const bool solid = domain.is_solid(bounce->wall);
      if (bounces == max_bounces) {  // in a narrow corner: back the way it came
        if (!state.reset_position.empty()) state.reset_position[i] += before[i] - state.position[i];
        become(bounce->wall, before[i], solid ? Vector3{} : -1.0 * state.velocity[i]);
        break;
      }
      const Vector3 x = bounce->image.position(state.position[i]);
      if (!state.reset_position.empty())
        state.reset_position[i] = solid ? state.reset_position[i] + (x - state.position[i])
                                        : x - bounce->image.vector(state.position[i] - state.reset_position[i]);
      if (solid) {
        const Vector3 n = domain.side(bounce->wall, before[i]) * domain.normal(bounce->wall);
        const double push = sph::contact_push(dot(state.velocity[i], n), 0, 1);
        become(bounce->wall, x,
               sph::after_contact(state.velocity[i], walls.contact(static_cast<std::size_t>(bounce->wall), x, n, 0),
                                  push));
      } else {
        become(bounce->wall, x, bounce->image.vector(state.velocity[i]));
        material.mirror(state.material, i, bounce->image);
      }
    }
  };
  const auto at_vessel = [&](std::size_t i, Loads::Impulses& received) {
    Vector3 &x = state.position[i], &velocity = state.velocity[i];
    const double mass = state.mass_of(i);
    const Vector3 moved_to = x;
    for (int bounces = 0;; ++bounces) {
      const auto met = vessel.first_crossing(before[i], x);
      if (!met) break;
      const Triangle& triangle = vessel.triangles()[met->triangle];
      const Vector3& normal = vessel.normal(met->triangle);
      const double beyond = dot(normal, x - triangle.corner[0]);  // of the other sign than where it came from
      const Vector3 n = beyond > 0 ? -1.0 * normal : normal, place = before[i] + met->at * (x - before[i]);
      if (const double push = sph::contact_push(dot(velocity, n), 0, 1); push > 0) {
        const std::size_t patch = setting.boundary.patch_of_part(triangle.patch);
        const Vector3 after = sph::after_contact(velocity, walls.contact(patch, place, n, 0), push);
        const Vector3 impulse = mass * (velocity - after);
        loads.receive(received, patch, impulse);
        loads.note(i, {setting.fields.under(vessel.part(met->triangle), place), mass * push, impulse});
        velocity = after;
      }
      x -= (2 * beyond) * normal;
      if (bounces == max_bounces_in_vessel) x = before[i];  // in a narrow corner: back to where it was
    }
    if (!state.reset_position.empty()) state.reset_position[i] += x - moved_to;
  };
  loads.collect(team, [&](std::size_t i, Loads::Impulses& received) {
    if (!stays_inside(domain, before[i], state.position[i])) at_planes(i, received);
    if (!vessel.is_empty() && neighbourhood.may_meet_vessel(i, before[i], state.position[i])) at_vessel(i, received);
  });
}

}  // namespace talus::continuum
