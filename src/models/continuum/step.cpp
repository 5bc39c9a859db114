// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/exact_sum.hpp"
#include "models/continuum/boundary/contact.hpp"
#include "models/continuum/pairs/displacement.hpp"
#include "models/continuum/pairs/stress_regularisation.hpp"
#include "models/continuum/population.hpp"
#include "models/continuum/setup/time_scale.hpp"
#include "physics/sph/pair_terms.hpp"

namespace talus::continuum {

namespace {

/// The stages of a step. Each stage that changes the state starts from the state at the start of the step, so that no
/// stage toggles a branch of the law.
struct Step {
  ThreadTeam& team;
  const Setup& setup;
  State& s;
  Workspace& w;
  double dt;  ///< s
  const Parameters& p = setup.given;

  // Stages of both integrators.
  void air() const;
  void gradients(const SummedColumns& columns, PairTerms terms) const;
  void drift(std::span<const Vector3> velocity) const;
  void density() const;
  void stress() const;
  void contact(double duration, std::span<const Vector3> position) const;
  void end() const;
  void lists() const;
  // Of the leapfrog.
  void kick() const;
  void midpoint_positions() const;
  // Of the midpoint rule.
  void half() const;
  void momentum() const;
  ContactSetting walls() const { return {p, w.boundary, w.load_fields, w.contact_distance, w.share}; }
  // Parts of `end` and `lists`.
  bool lists_hold() const;
  void damping() const;
  void clock() const;
};

/// Velocities are staggered by half a step. The scheme neither damps nor amplifies waves, and evaluates forces and
/// gradients once each.
void advance_leapfrog(const Step& step) {
  State& s = step.s;
  Workspace& w = step.w;
  step.kick();
  step.contact(0.5 * (s.last_step + step.dt), s.position);
  step.midpoint_positions();
  step.gradients({w.position, s.velocity, s.density, w.smoothing_length, s.material, s.mass_ratio},
                 PairTerms::gradients);
  step.drift(s.velocity);
  step.density();
  step.stress();
  step.end();
  // While the gradients are in the order of the particles.
  measure_shear_rate(step.team, s, w);
  step.lists();
  evaluate(step.team, step.p, s, w);
}

/// The explicit midpoint rule (Runge-Kutta of second order).
void advance_midpoint(const Step& step) {
  State& s = step.s;
  Workspace& w = step.w;
  step.half();
  step.gradients({w.position, w.velocity, w.density, w.midpoint_smoothing_length, w.columns, s.mass_ratio},
                 PairTerms::all);
  step.drift(w.velocity);
  step.momentum();
  step.density();
  step.stress();
  step.contact(step.dt, w.position);
  step.end();
  step.lists();
  evaluate(step.team, step.p, s, w);
  measure_shear_rate(step.team, s, w);
}

}  // namespace

/// On entry and exit the rates, packing and neighbour lists belong to the state.
void advance(ThreadTeam& team, const Setup& setup, State& s, Workspace& w) {
  if (w.air && w.air->is_due(s)) w.air->take_grains(team, w.smoothing_length, s);
  const Step step{team, setup, s, w, step_length(team, setup, s, w)};
  step.air();
  setup.given.integration.method == Method::runge_kutta ? advance_midpoint(step) : advance_leapfrog(step);
}

namespace {

/// Gravity at a time; while a bed is filled in layers it depends on the height.
struct Gravity {
  const Setup& setup;
  double time;
  bool by_height = setup.loading.is_by_height(time);
  Vector3 everywhere = at_height(0);

  Vector3 at_height(double z) const {
    const double g = setup.loading.share(time, z) * setup.given.gravity.acceleration, tilt = setup.given.gravity.tilt;
    return {g * std::sin(tilt), 0, -g * std::cos(tilt)};
  }
  Vector3 at(const Vector3& x) const { return by_height ? at_height(x.z) : everywhere; }

  /// Adds the impulse of all particles within a duration to that of the state.
  void add_impulse(ThreadTeam& team, double duration, State& s, Share& share) const {
    if (!by_height && !s.has.mass_ratio) {
      s.gravity_impulse += (duration * s.mass * static_cast<double>(share.of_all(s.velocity.size()))) * everywhere;
      return;
    }
    const FixedPoint point(s.impulse_unit);
    const FixedVector given = accumulate(
        team, s.position.size(), FixedVector{},
        [&](std::size_t i, FixedVector& sum) {
          if (share.owns(i)) sum.add(point, (duration * s.mass_of(i)) * at(s.position[i]));
        },
        [](FixedVector a, const FixedVector& b) { return a += b; });
    share.add_later({given},
                    [point, &s](std::span<const FixedVector> all) { s.gravity_impulse += all[0].value(point); });
  }
};

/// Acceleration by the air, constant during a step of the air.
Vector3 by_air(const State& s, std::size_t i) {
  return s.air.acceleration.empty() ? Vector3{} : s.air.acceleration[i];
}

void measure_strain_at(ThreadTeam& team, State& s, Workspace& w, std::vector<Vector3>& position) {
  if (!w.material.by_displacements()) return;
  w.share.refresh(std::array{Halo::column(std::span(position)), Halo::column(std::span(s.reset_position))});
  measure_strain(team, w.pairs.neighbourhood(), position, s.reset_position, w.smoothing_length, w.measured_strain);
}

/// At the end of a step of the air: takes its next step, which fixes the acceleration of the particles until its end.
void Step::air() const {
  if (w.air) w.air->advance(team, dt, s);
}

/// The state at the midpoint of the step, in the workspace, from the rates at its start.
void Step::half() const {
  const Gravity start{setup, s.time};
  for_each(team, s.position.size(), [&](std::size_t i) {
    w.position[i] = s.position[i] + (0.5 * dt) * s.velocity[i];
    w.velocity[i] = s.velocity[i] + (0.5 * dt) * (w.rates.acceleration[i] + start.at(s.position[i]) + by_air(s, i));
    w.density[i] = sph::density_after(s.density[i], (0.5 * dt) * w.rates.density_rate[i]);
    w.midpoint_smoothing_length[i] = w.pairs.smoothing_length(w.density[i], s.ratios()[i]);
  });
  prevent_approach(team, walls(), w.rates, s, dt, w.pairs, w.velocity);
  measure_strain_at(team, s, w, w.position);
  w.material.update(team, s.material, w.rates.velocity_gradient, w.measured_strain, w.density, 0.5 * dt, w.columns,
                    false);
}

/// Velocity gradient and rate of the density at the midpoint of the step, and the acceleration there if requested.
void Step::gradients(const SummedColumns& columns, PairTerms terms) const {
  // What else gradients alone read is as the forces met it.
  if (terms == PairTerms::gradients)
    w.share.refresh(std::array{Halo::column(std::span(columns.position)), Halo::column(std::span(columns.velocity))});
  else
    refresh_halo(w, columns);
  w.pairs(team, columns.view(), terms, w.rates);
}

/// Eq. 17 over the second half of the last step and the first of this one; the air's force acts over this step.
void Step::kick() const {
  const double duration = 0.5 * (s.last_step + dt);
  const Gravity g{setup, s.time};
  for_each(team, s.velocity.size(), [&](std::size_t i) {
    s.velocity[i] += duration * (w.rates.acceleration[i] + g.at(s.position[i])) + dt * by_air(s, i);
  });
  g.add_impulse(team, duration, s, w.share);
}

/// Eq. 17 with the forces at the midpoint of the step.
void Step::momentum() const {
  const Gravity g{setup, s.time + 0.5 * dt};
  for_each(team, s.velocity.size(), [&](std::size_t i) {
    s.velocity[i] += dt * (w.rates.acceleration[i] + g.at(s.position[i]) + by_air(s, i));
  });
  g.add_impulse(team, dt, s, w.share);
}

void Step::midpoint_positions() const {
  for_each(team, s.position.size(), [&](std::size_t i) { w.position[i] = s.position[i] + (0.5 * dt) * s.velocity[i]; });
}

/// The workspace keeps the previous positions.
void Step::drift(std::span<const Vector3> velocity) const {
  for_each(team, s.position.size(), [&](std::size_t i) {
    w.position[i] = s.position[i];
    s.position[i] += dt * velocity[i];
  });
}

/// Eq. 16. The gradients of a particle that is all but alone are those of one or two neighbours, and what they open
/// where there are none, beyond a wall above all, would thin it out without end, the more the farther its kernel then
/// reaches: it is held where the kernel is three times as wide as the bed's.
void Step::density() const {
  const double thinnest = setup.density / 27, relaxation = density_relaxation(p);
  const bool by_lasting_rate = !s.lasting_rate[0].empty(), upwards_only = !is_loose_where_free(p);
  for_each(team, s.density.size(), [&](std::size_t i) {
    double after = sph::density_after(s.density[i], dt * w.rates.density_rate[i]);
    if (relaxation > 0) {
      const double shear = by_lasting_rate ? shear_of(tensor_at(s.lasting_rate, i)) : s.shear_rate[i];
      const double sum = w.rates.kernel_density[i], towards = upwards_only ? std::max(sum, s.density[i]) : sum;
      after += sph::density_towards(towards, s.density[i], relaxation * dt * shear);
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
void Step::contact(double duration, std::span<const Vector3> position) const {
  apply_contact(team, walls(), w.rates, position, {duration, dt}, w.pairs, s);
}

/// What ends a step: particles that crossed a boundary come back, the clock moves on, phases change.
void Step::end() const {
  reflect(team, walls(), w.material, w.pairs.neighbourhood(), w.position, s);
  damping();
  clock();
  const Domain& domain = w.boundary.domain();
  Votes votes{.least = {}, .largest = {}, .sum = {count_moving(team, setup, w.share, s)}};
  w.share.join(s, votes, find_fault(team, p, domain, w.share, s, dt),
               [&](std::size_t i) { return report_of(p, domain, s, dt, i); });
  update_phase(team, setup, votes.sum[0], s, w);
}

/// Feeds inlets; builds the neighbour lists where they no longer hold, and removes what has left.
void Step::lists() const {
  const bool fed = feed(p, s, w);
  update_smoothing_lengths(team, s, w);
  if (!fed && lists_hold() && !std::exchange(w.drops_lists, false)) return;
  drop_halo(p, s, w);
  if (remove_particles(p, s, w)) update_smoothing_lengths(team, s, w);
  find_neighbours(team, p, s, w);
}

/// Several processes vote on it, and on what limits the next step with the same message.
bool Step::lists_hold() const {
  bool hold = w.pairs.neighbourhood().holds(team, s.position, w.smoothing_length);
  if (w.share.is_all()) return hold;
  const GrainLimits limits = joined_limits(team, s, w, hold);
  if (hold) w.limits = limits;
  return hold;
}

void Step::damping() const {
  if (!p.settle.damping_time || s.gate_time >= 0 || is_pouring(p.inlets, s.time)) return;
  const double left = std::exp(-dt / *p.settle.damping_time);
  const FixedPoint point(s.impulse_unit);
  const FixedVector taken = accumulate(
      team, s.velocity.size(), FixedVector{},
      [&](std::size_t i, FixedVector& sum) {
        if (!w.share.owns(i)) return;
        const Vector3 before = s.velocity[i];
        s.velocity[i] = left * before;
        sum.add(point, s.mass_of(i) * (before - s.velocity[i]));
      },
      [](FixedVector a, const FixedVector& b) { return a += b; });
  w.share.add_later({taken},
                    [point, &s = s](std::span<const FixedVector> all) { s.damping_impulse += all[0].value(point); });
}

void Step::clock() const {
  s.time += dt;
  if (is_window_over(s.time, setup.scales.peak_time(), s.wall_loads)) w.share.join_window(s.wall_loads);
  close_window(w.load_fields, s.time, setup.scales.peak_time(), s.wall_loads);
  s.last_step = dt;
  ++s.step;
}

}  // namespace

void begin(ThreadTeam& team, const Setup& setup, State& s, Workspace& w) {
  const Parameters& p = setup.given;
  w.share.begin(s);
  fit(p, s, w);
  if (p.gate.opens == GateOpens::from_the_start) {
    s.gate_time = 0;
    w.boundary.move_gates(0);
  }
  update_smoothing_lengths(team, s, w);
  find_neighbours(team, p, s, w);
  begin_densities(team, setup, s, w);
  if (w.air) w.air->begin(team, w.smoothing_length, s);
  evaluate(team, p, s, w);
  measure_shear_rate(team, s, w);
}

void derive(ThreadTeam& team, const Setup& setup, State& s, Workspace& w) {
  w.share.begin(s);
  fit(setup.given, s, w);
  if (s.gate_time >= 0) w.boundary.move_gates(s.time - s.gate_time);
  update_smoothing_lengths(team, s, w);
  build_lists(team, setup.given, s, w);
  evaluate(team, setup.given, s, w);
}

}  // namespace talus::continuum
