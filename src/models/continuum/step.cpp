// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/exact_sum.hpp"
#include "models/continuum/boundary/vessel_contact.hpp"
#include "models/continuum/boundary/walls.hpp"
#include "models/continuum/check_state.hpp"
#include "models/continuum/pairs/displacement.hpp"
#include "models/continuum/pairs/stress_regularisation.hpp"
#include "models/continuum/phase.hpp"
#include "models/continuum/population.hpp"
#include "models/continuum/setup/loading.hpp"
#include "physics/sph/pair_terms.hpp"

namespace talus::continuum {

namespace {

/// The stages of a step. Each stage that changes the state starts from the state at the start of the step, so that no
/// stage toggles a branch of the law.
struct Step {
  ThreadTeam& team;
  const Parameters& p;
  State& s;
  Workspace& w;
  double dt;  ///< s

  void air() const;
  void half() const;
  void gradient(std::span<const Vector3> velocity, std::span<const double> density,
                std::span<const double> smoothing_length, const MaterialColumns& material, SweepTerms terms) const;
  void momentum(double duration, double time) const;
  void drift(double duration, std::span<const Vector3> velocity) const;
  void density() const;
  void stress() const;
  void walls(double duration, std::span<const Vector3> position) const;
  void damping() const;
  void clock() const;
};

double step_length(ThreadTeam& team, const Parameters& p, State& s, Workspace& w);

}  // namespace

/// On entry and exit the rates, packing and neighbour lists belong to the state.
void advance(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  const Step step{team, p, s, w, step_length(team, p, s, w)};
  const double dt = step.dt;
  step.air();
  if (p.integration.method == Method::runge_kutta) {
    // The explicit midpoint rule.
    step.half();
    step.gradient(w.velocity, w.density, w.half_length, w.columns, SweepTerms::all);
    step.drift(dt, w.velocity);
    step.momentum(dt, s.time + 0.5 * dt);
    step.density();
    step.stress();
    step.walls(dt, w.position);
  } else {
    // The leapfrog: velocities are staggered by half a step. It neither damps nor amplifies waves, and evaluates forces
    // and gradients once each.
    const double kick = 0.5 * (s.last_step + dt);
    step.momentum(kick, s.time);
    step.walls(kick, s.position);
    for_each(team, s.position.size(),
             [&](std::size_t i) { w.position[i] = s.position[i] + (0.5 * dt) * s.velocity[i]; });
    step.gradient(s.velocity, s.density, w.smoothing_length, s.material, SweepTerms::gradients);
    step.drift(dt, s.velocity);
    step.density();
    step.stress();
  }
  reflect_at_walls(team, p, w.material, w.domain, w.position, s);
  reflect_at_vessel(team, p, w.vessel, w.sweep.neighbourhood(), w.load_fields, w.position, s);
  step.damping();
  step.clock();
  check_state(team, p, w.domain, s, dt);
  update_phase(team, p, s, w);
  const bool whole = p.integration.method == Method::runge_kutta;
  // While the gradients are in the order of the particles.
  keep_deformation_rate(team, s, w);
  if (!whole) measure_shear_rate(team, s, w);
  const bool fed = feed(p, s, w);
  update_smoothing_lengths(team, s, w);
  if (fed || !w.sweep.neighbourhood().holds(team, s.position, w.smoothing_length)) {
    if (remove_particles(p, s, w)) update_smoothing_lengths(team, s, w);
    find_neighbours(team, p, s, w);
  }
  evaluate(team, p, s, w);
  if (whole) measure_shear_rate(team, s, w);
}

namespace {

/// In a step no particle within the box moves farther than this, in spacings: faster ones would reach what the lists
/// of neighbours do not hold, and pass through each other.
constexpr double max_advance = 0.25;

/// What limits the step of the grains.
struct GrainLimits {
  double min_smoothing_length = std::numeric_limits<double>::infinity();  ///< m
  double max_square_speed = 0;                                            ///< of the particles within the box, m^2/s^2
};

GrainLimits limits_of_grains(ThreadTeam& team, const State& s, const Workspace& w) {
  return accumulate(
      team, w.smoothing_length.size(), GrainLimits{},
      [&](std::size_t i, GrainLimits& limits) {
        limits.min_smoothing_length = std::min(limits.min_smoothing_length, w.smoothing_length[i]);
        const double square = dot(s.velocity[i], s.velocity[i]);
        if (square > limits.max_square_speed && w.domain.box().contains(s.position[i]))
          limits.max_square_speed = square;
      },
      [](const GrainLimits& a, const GrainLimits& b) {
        return GrainLimits{std::min(a.min_smoothing_length, b.min_smoothing_length),
                           std::max(a.max_square_speed, b.max_square_speed)};
      });
}

/// The longest step in which nothing moves farther than max_advance, s.
double step_of_speed(const Parameters& p, const GrainLimits& limits) {
  return max_advance * p.bed.spacing / std::sqrt(limits.max_square_speed);
}

/// The step that pressure waves and the speed of the grains allow, s, or the fixed one; without particles that of the
/// bed's.
double step_of_grains(const Parameters& p, const GrainLimits& limits, const Workspace& w) {
  if (p.integration.step) return *p.integration.step;
  if (w.smoothing_length.empty())
    return p.integration.courant * w.sweep.smoothing_length(p.bed.packing * p.grains.density) / w.sound_speed;
  return std::min(p.integration.courant * limits.min_smoothing_length / w.sound_speed, step_of_speed(p, limits));
}

/// The time step, decided only here, s: the limit of the grains; at the start of a step of the air also the limit of
/// the air; until the end of that step unchanged.
double step_length(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  if (!w.air) return step_of_grains(p, limits_of_grains(team, s, w), w);
  if (!w.air->is_due(s)) return s.last_step;
  w.air->take_grains(team, w.smoothing_length, s);
  return std::min(step_of_grains(p, limits_of_grains(team, s, w), w), w.air->longest_step());
}

Vector3 gravity(const Parameters& p, const Workspace& w, double time) {
  return {0, 0, -share_of_gravity(time, w.loading_time) * p.gravity.acceleration};
}

/// Acceleration by the air, constant during a step of the air.
Vector3 by_air(const State& s, std::size_t i) {
  return s.air.acceleration.empty() ? Vector3{} : s.air.acceleration[i];
}

void measure_strain_at(ThreadTeam& team, const State& s, Workspace& w, std::span<const Vector3> position) {
  if (w.material.by_displacements())
    measure_strain(team, w.sweep.neighbourhood(), position, s.reset_position, w.smoothing_length, w.measured_strain);
}

/// At the end of a step of the air: takes its next step, which fixes the acceleration of the particles until its end.
void Step::air() const {
  if (w.air) w.air->advance(team, dt, s);
}

/// The state at the midpoint of the step, in the workspace, from the rates at its start.
void Step::half() const {
  const Vector3 start = gravity(p, w, s.time);
  for_each(team, s.position.size(), [&](std::size_t i) {
    w.position[i] = s.position[i] + (0.5 * dt) * s.velocity[i];
    w.velocity[i] = s.velocity[i] + (0.5 * dt) * (w.rates.acceleration[i] + start + by_air(s, i));
    w.density[i] = sph::density_after(s.density[i], (0.5 * dt) * w.rates.density_rate[i]);
    w.half_length[i] = w.sweep.smoothing_length(w.density[i]);
  });
  const ContactStep step{dt, dt, w.contact_distance};
  hold_off_walls(team, w.domain, w.rates, s.position, step, w.velocity);
  hold_off_vessel(team, w.rates, s.position, step, w.sweep, w.velocity);
  measure_strain_at(team, s, w, w.position);
  w.material.update(team, s.material, w.rates.velocity_gradient, w.measured_strain, w.density, 0.5 * dt, w.columns,
                    false);
}

/// Velocity gradient and rate of the density at the midpoint of the step, and the acceleration there if requested.
void Step::gradient(std::span<const Vector3> velocity, std::span<const double> density,
                    std::span<const double> smoothing_length, const MaterialColumns& material, SweepTerms terms) const {
  w.sweep(team, {w.position, velocity, density, smoothing_length, material, s.deformation_rate}, terms, w.rates);
}

/// Eq. 17. \param duration of the force of stress and gravity, that of the air's is dt, s; \param time of gravity, s
void Step::momentum(double duration, double time) const {
  const Vector3 g = gravity(p, w, time);
  const bool whole = p.integration.method == Method::runge_kutta;
  for_each(team, s.velocity.size(), [&](std::size_t i) {
    const Vector3 a = w.rates.acceleration[i] + g, air = by_air(s, i);
    s.velocity[i] += whole ? duration * (a + air) : duration * a + dt * air;
  });
  s.gravity_impulse += (duration * s.mass * static_cast<double>(s.velocity.size())) * g;
}

/// The workspace keeps the previous positions.
void Step::drift(double duration, std::span<const Vector3> velocity) const {
  for_each(team, s.position.size(), [&](std::size_t i) {
    w.position[i] = s.position[i];
    s.position[i] += duration * velocity[i];
  });
}

/// Eq. 16. The gradients of a particle that is all but alone are those of one or two neighbours, and what they open
/// where there are none, beyond a wall above all, would thin it out without end, the more the farther its kernel then
/// reaches: it is held where the kernel is three times as wide as the bed's.
void Step::density() const {
  const double thinnest = p.bed.packing * p.grains.density / 27, relaxation = density_relaxation(p);
  const bool by_lasting_rate = !s.lasting_rate[0].empty();
  for_each(team, s.density.size(), [&](std::size_t i) {
    double after = sph::density_after(s.density[i], dt * w.rates.density_rate[i]);
    if (relaxation > 0) {
      const double shear = by_lasting_rate ? shear_of(tensor_at(s.lasting_rate, i)) : s.shear_rate[i];
      after += sph::density_towards(w.rates.kernel_density[i], s.density[i], relaxation * dt * shear);
    }
    // In this order a density that is no number stays one, and is found.
    s.density[i] = std::max(after, thinnest);
  });
}

/// The law over the whole step; the displacement of a particle whose strain is reset is counted from here.
void Step::stress() const {
  measure_strain_at(team, s, w, s.position);
  const bool displaced = w.material.by_displacements();
  if (displaced) w.resets.assign(w.material.resets(s.material).begin(), w.material.resets(s.material).end());
  w.material.update(team, s.material, w.rates.velocity_gradient, w.measured_strain, s.density, dt, s.material, true);
  if (stress_regularisation(p) > 0) regularise_stress(team, p, dt, w.rates, s);
  if (!displaced) return;
  const std::span<const double> resets = w.material.resets(s.material);
  for_each(team, resets.size(), [&](std::size_t i) {
    if (resets[i] != w.resets[i]) s.reset_position[i] = s.position[i];
  });
}

/// Contact with walls, friction, and their loads. \param position of the particles that the rates are of
void Step::walls(double duration, std::span<const Vector3> position) const {
  const ContactStep step{duration, dt, w.contact_distance};
  apply_wall_contact(team, p, w.domain, w.rates, position, step, s);
  apply_vessel_contact(team, p, w.load_fields, w.rates, step, w.sweep, s);
}

void Step::damping() const {
  if (!p.settle.damping_time || s.gate_time >= 0) return;
  const double left = std::exp(-dt / *p.settle.damping_time);
  const FixedPoint point(s.impulse_unit);
  const FixedVector taken = accumulate(
      team, s.velocity.size(), FixedVector{},
      [&](std::size_t i, FixedVector& sum) {
        const Vector3 before = s.velocity[i];
        s.velocity[i] = left * before;
        sum.add(point, s.mass * (before - s.velocity[i]));
      },
      [](FixedVector a, const FixedVector& b) { return a += b; });
  s.damping_impulse += taken.value(point);
}

void Step::clock() const {
  s.time += dt;
  close_window(w.load_fields, s.time, w.scales.peak_time(), s.wall_loads);
  s.last_step = dt;
  ++s.step;
}

}  // namespace

void begin(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  if (p.gate.opens == GateOpens::from_the_start) {
    s.gate_time = 0;
    open_gates(p, w.vessel, 0);
  }
  update_smoothing_lengths(team, s, w);
  find_neighbours(team, p, s, w);
  begin_densities(team, p, s, w);
  if (w.air) w.air->begin(team, w.smoothing_length, s);
  evaluate(team, p, s, w);
  measure_shear_rate(team, s, w);
}

void derive(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  if (s.gate_time >= 0) {
    w.domain.open_gates(s.time - s.gate_time);
    open_gates(p, w.vessel, s.time - s.gate_time);
  }
  update_smoothing_lengths(team, s, w);
  w.sweep.find_neighbours(team, s.list_position, s.list_smoothing_length, s.list_margin);
  evaluate(team, p, s, w);
}

NumericalError::Report step_limit(const Parameters& p, const State& s, const Workspace& w) {
  NumericalError::Report report{};
  if (s.position.empty()) {
    report.term = "step without particles", report.place = "an empty vessel", report.advice = "integration.courant";
    return report;
  }
  // That of the densest particle, or of the fastest within the box.
  std::size_t densest = 0, fastest = 0;
  GrainLimits limits;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const double square = dot(s.velocity[i], s.velocity[i]);
    if (w.smoothing_length[i] < limits.min_smoothing_length)
      limits.min_smoothing_length = w.smoothing_length[densest = i];
    if (square > limits.max_square_speed && w.domain.box().contains(s.position[i]))
      limits.max_square_speed = square, fastest = i;
  }
  const double of_grains = step_of_grains(p, limits, w);
  if (w.air && s.last_step < 0.5 * of_grains) return w.air->step_limit(s);
  const bool by_speed = !(of_grains < step_of_speed(p, limits));
  const std::size_t i = by_speed ? fastest : densest;
  const Vector3& x = s.position[i];
  if (p.integration.step) {
    report.term = "integration.step";
  } else if (by_speed) {
    report.term = fmt::format("a particle moves {:g} of bed.spacing in a step at most: the fastest has {:.4g} m/s",
                              max_advance, std::sqrt(limits.max_square_speed));
  } else {
    report.term = fmt::format("Courant number of the grains, where they are densest, at {:.4g} kg/m3", s.density[i]);
  }
  report.place = fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m", s.identity[i], x.x, x.y, x.z);
  report.advice = "a stiffer law of the grains, a larger sph.viscosity_alpha";
  return report;
}

}  // namespace talus::continuum
