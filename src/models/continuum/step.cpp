// SPDX-License-Identifier: Apache-2.0
/// A step in order: (0) where the particles have come to the end of the air's step, the air goes on by the next one and
/// fixes what it gives them in each of theirs; (1) positions, velocities, densities and stresses move on, by the
/// midpoint rule or the leapfrog, each stage starting from the state at the start of the step, so that none toggles a
/// branch of the law; (2) walls rub and turn back; (3) the phase is looked at: the gate opens when its time has come or
/// the bed is at rest; (4) where particles have moved too far, they are sorted now and then and the neighbour lists are
/// built; (5) the rates of the new state are evaluated: they open the next step. On entry and exit: rates, packing and
/// lists belong to the state.
#include "models/continuum/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "models/continuum/displacement.hpp"
#include "models/continuum/loading.hpp"
#include "models/continuum/sort.hpp"
#include "models/continuum/walls.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

constexpr std::uint64_t builds_between_sorts = 16;

Vector3 gravity(const Parameters& p, const Workspace& w, double time) {
  return {0, 0, -share_of_gravity(time, w.loading_time) * p.gravity.acceleration};
}

/// Acceleration by the air, which lasts over a step of its own.
Vector3 by_air(const State& s, std::size_t i) {
  return s.air.acceleration.empty() ? Vector3{} : s.air.acceleration[i];
}

void measure_strain_at(ThreadTeam& team, const State& s, Workspace& w, std::span<const Vector3> position) {
  if (w.material.by_displacements())
    measure_strain(team, w.sweep.neighbourhood(), position, s.reset_position, w.smoothing_length, w.measured_strain);
}

/// The law over the whole step; a particle whose strain it resets has its displacement counted anew from here.
void strain(ThreadTeam& team, State& s, Workspace& w, double dt) {
  measure_strain_at(team, s, w, s.position);
  const bool displaced = w.material.by_displacements();
  if (displaced) w.resets.assign(w.material.resets(s.material).begin(), w.material.resets(s.material).end());
  w.material.update(team, s.material, w.rates.velocity_gradient, w.measured_strain, s.density, dt, s.material, true);
  if (!displaced) return;
  const std::span<const double> resets = w.material.resets(s.material);
  for_each(team, resets.size(), [&](std::size_t i) {
    if (resets[i] != w.resets[i]) s.reset_position[i] = s.position[i];
  });
}

/// The explicit midpoint rule.
void runge_kutta(ThreadTeam& team, const Parameters& p, State& s, Workspace& w, double dt) {
  const Vector3 start = gravity(p, w, s.time), g = gravity(p, w, s.time + 0.5 * dt);
  const std::size_t count = s.position.size();
  for_each(team, count, [&](std::size_t i) {
    w.position[i] = s.position[i] + (0.5 * dt) * s.velocity[i];
    w.velocity[i] = s.velocity[i] + (0.5 * dt) * (w.rates.acceleration[i] + start + by_air(s, i));
    w.density[i] = s.density[i] + (0.5 * dt) * w.rates.density_rate[i];
  });
  measure_strain_at(team, s, w, w.position);
  w.material.update(team, s.material, w.rates.velocity_gradient, w.measured_strain, w.density, 0.5 * dt, w.columns,
                    false);
  w.sweep(team, {w.position, w.velocity, w.density, w.columns}, Wanted::all, w.rates);
  for_each(team, count, [&](std::size_t i) {
    w.position[i] = s.position[i];
    s.position[i] += dt * w.velocity[i];
    s.velocity[i] += dt * (w.rates.acceleration[i] + g + by_air(s, i));
    s.density[i] += dt * w.rates.density_rate[i];
  });
  strain(team, s, w, dt);
  s.gravity_impulse += (dt * s.mass * static_cast<double>(count)) * g;
  meet_walls(team, p, w.sweep.neighbourhood().domain(), w.rates, w.position, dt, s);
}

/// Velocities live half a step before positions, densities and stresses: kick, half a drift, strain, half a drift. It
/// neither damps nor feeds waves, and evaluates forces and gradients once each.
void leapfrog(ThreadTeam& team, const Parameters& p, State& s, Workspace& w, double dt) {
  const Vector3 g = gravity(p, w, s.time);
  const double kick = 0.5 * (s.last_step + dt);
  const std::size_t count = s.position.size();
  for_each(team, count,
           [&](std::size_t i) { s.velocity[i] += kick * (w.rates.acceleration[i] + g) + dt * by_air(s, i); });
  s.gravity_impulse += (kick * s.mass * static_cast<double>(count)) * g;
  meet_walls(team, p, w.sweep.neighbourhood().domain(), w.rates, s.position, kick, s);
  for_each(team, count, [&](std::size_t i) { w.position[i] = s.position[i] + (0.5 * dt) * s.velocity[i]; });
  w.sweep(team, {w.position, s.velocity, s.density, s.material}, Wanted::gradients, w.rates);
  for_each(team, count, [&](std::size_t i) {
    w.position[i] = s.position[i];
    s.position[i] += dt * s.velocity[i];
    s.density[i] += dt * w.rates.density_rate[i];
  });
  strain(team, s, w, dt);
}

void damp(ThreadTeam& team, const Parameters& p, State& s, double dt) {
  if (!p.settle.damping_time || s.gate_time >= 0) return;
  const double left = std::exp(-dt / *p.settle.damping_time);
  const Vector3 momentum = reduce(
      team, s.velocity.size(), Vector3{},
      [&](std::size_t i) {
        s.velocity[i] = left * s.velocity[i];
        return s.velocity[i];
      },
      [](const Vector3& a, const Vector3& b) { return a + b; });
  s.damping_impulse += (s.mass * (1 / left - 1)) * momentum;
}

/// A particle of no or of hardly any density reaches past plates and faces; one that jumps over its neighbours in a
/// step was thrown by stresses that cannot be.
struct Possible {
  double least_density;  // kg/m^3
  double most_speed;     // m/s

  Possible(const Parameters& p, const State& s, const Workspace& w, double dt)
      : least_density(p.sph.smoothing == Smoothing::fixed
                          ? 0
                          : s.mass * std::pow(0.5 * (w.sweep.neighbourhood().domain().largest_reach() -
                                                     p.integration.skin * p.bed.spacing),
                                              -3)),
        most_speed(p.bed.spacing / dt) {}

  bool density(double value) const { return value > least_density && std::isfinite(value); }
  bool velocity(const Vector3& v) const { return norm(v) <= most_speed; }
};

[[noreturn]] void give_up(const Parameters& p, const State& s, const Possible& possible, std::size_t i) {
  const Vector3& x = s.position[i];
  const bool density = !possible.density(s.density[i]);
  const double speed = norm(s.velocity[i]);
  throw NumericalError({.what = density ? fmt::format("the bulk density is {:.4g} kg/m3", s.density[i])
                                : std::isfinite(speed)
                                    ? fmt::format("the speed is {:.4g} m/s, more than a spacing a step", speed)
                                    : "the velocity is not finite",
                        .term = density ? "continuity, Eq. 16" : "momentum, Eq. 17",
                        .place = fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m", s.identity[i], x.x, x.y, x.z),
                        .step = s.step,
                        .time = s.time,
                        .advice = fmt::format("a smaller {}, a larger sph.viscosity_alpha",
                                              p.integration.step ? "integration.step" : "integration.courant")});
}

void check_possible(ThreadTeam& team, const Parameters& p, const State& s, const Workspace& w, double dt) {
  const Possible possible(p, s, w, dt);
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  const std::size_t worst = reduce(
      team, s.position.size(), none,
      [&](std::size_t i) { return possible.velocity(s.velocity[i]) && possible.density(s.density[i]) ? none : i; },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  if (worst != none) give_up(p, s, possible, worst);
}

void measure(ThreadTeam& team, const State& s, Workspace& w) {
  for_each(team, s.position.size(),
           [&](std::size_t i) { w.smoothing_length[i] = w.sweep.smoothing_length(s.density[i]); });
}

void find_neighbours(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  if (s.list_builds % builds_between_sorts == 0) {
    sort_for_locality(s, sph::support * p.bed.spacing);
    measure(team, s, w);
  }
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vector3 wrapped = w.sweep.neighbourhood().domain().wrap(s.position[i]);
    if (!s.reset_position.empty()) s.reset_position[i] += wrapped - s.position[i];
    s.position[i] = wrapped;
  }
  s.list_position = s.position;
  s.list_smoothing_length = w.smoothing_length;
  ++s.list_builds;
  w.sweep.find_neighbours(team, s.list_position, s.list_smoothing_length);
}

/// The rates of the state, with what derives from them.
void evaluate(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  const bool all = p.integration.method == Method::runge_kutta;
  w.sweep(team, {s.position, s.velocity, s.density, s.material}, all ? Wanted::all : Wanted::forces, w.rates);
  s.packing.resize(s.position.size());
  s.strain.resize(s.position.size());
  for_each(team, s.position.size(), [&](std::size_t i) {
    s.packing[i] = w.rates.kernel_density[i] / p.grains.density;
    s.strain[i] = w.material.strain(s.material, i);
  });
}

/// From the gradients last evaluated: with the leapfrog those in the middle of the step, which the state at its end
/// cannot give again. A resumed run has it from its checkpoint.
void measure_shear_rate(ThreadTeam& team, State& s, const Workspace& w) {
  s.shear_rate.resize(s.position.size());
  for_each(team, s.position.size(), [&](std::size_t i) {
    const SymmetricTensor3<> rate = deviator(symmetric_part(w.rates.velocity_gradient[i]));
    s.shear_rate[i] = std::sqrt(2 * double_dot(rate, rate));
  });
}

/// Whether a particle in a free surface is as loose as the kernel, half empty there, says it is. Eq. 16 keeps what
/// separates a density from the kernel's sum, wherever the particle goes: one that began at a free surface with the
/// density of the bed would be buried at a packing of 0.51 and bear as much there as others at 0.6. A body that bears
/// tension would pull its own skin in; its surfaces stay surfaces.
bool is_loose_where_free(const Parameters& p, const Material& material) {
  return p.sph.continuity == Continuity::printed && !material.bears_tension();
}

/// The densities begin as the kernel's sums with the bed's smoothing length, though nowhere above the bed's: beside a
/// wall at an angle the images are not a lattice, and the sum is some per cent off.
void begin_densities(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  if (!is_loose_where_free(p, w.material)) return;
  evaluate(team, p, s, w);
  const double bed = p.bed.packing * p.grains.density;
  for_each(team, s.density.size(), [&](std::size_t i) { s.density[i] = std::min(bed, w.rates.kernel_density[i]); });
  measure(team, s, w);
  find_neighbours(team, p, s, w);
}

/// What lay on a gate that has gone faces nothing: its kernel's sum loses the gate's images, and its density with it.
void open_gates(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  const double time = s.time - s.gate_time;
  if (!w.sweep.neighbourhood().domain().has_gates_due(time)) return;
  evaluate(team, p, s, w);
  const std::vector<double> before = w.rates.kernel_density;
  w.open_gates(time);
  if (!is_loose_where_free(p, w.material)) return;
  evaluate(team, p, s, w);
  for_each(team, s.density.size(), [&](std::size_t i) { s.density[i] += w.rates.kernel_density[i] - before[i]; });
}

/// Settle, open, run: looks whether the bed is at rest, and opens the gate when it is time.
void look_at_phase(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  const double limit = p.settle.speed * p.settle.speed;
  const auto moving = reduce(
      team, s.velocity.size(), std::size_t{0},
      [&](std::size_t i) { return std::size_t{dot(s.velocity[i], s.velocity[i]) >= limit}; },
      [](std::size_t a, std::size_t b) { return a + b; });
  const bool quiet = s.time >= w.loading_time && 100 * moving <= s.velocity.size();
  if (!quiet) s.quiet_time = -1;
  if (quiet && s.quiet_time < 0) s.quiet_time = s.time;
  if (s.gate_time >= 0) return open_gates(team, p, s, w);
  const bool settled = quiet && s.time - s.quiet_time >= p.settle.duration;
  if (p.gate.opens == GateOpens::at_time ? s.time >= p.gate.time : settled) {
    s.gate_time = s.time;
    open_gates(team, p, s, w);
  } else if (p.gate.opens == GateOpens::when_settled && s.time > p.settle.longest) {
    throw NumericalError(
        {.what = "the bed has not settled",
         .term = fmt::format("{} of {} particles are faster than settle.speed", moving, s.velocity.size()),
         .place = "the bed",
         .step = s.step,
         .time = s.time,
         .advice = "a shorter settle.damping_time, a larger settle.speed or settle.longest; along "
                   "inclined walls, walls.friction_from = \"start\""});
  }
}

}  // namespace

Workspace::Workspace(const Parameters& parameters, const State& state)
    : material(parameters),
      sound_speed(material.sound_speed(parameters.bed.packing * parameters.grains.density)),
      loading_time(continuum::loading_time(parameters, sound_speed)),
      sweep(parameters, state.mass, sound_speed),
      air(parameters.air.enabled ? std::make_unique<Atmosphere>(parameters) : nullptr),
      position(state.position.size()),
      velocity(state.position.size()),
      density(state.position.size()),
      columns(state.material),
      smoothing_length(state.position.size()) {}

void begin(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  if (p.gate.opens == GateOpens::from_the_start) s.gate_time = 0;
  measure(team, s, w);
  find_neighbours(team, p, s, w);
  begin_densities(team, p, s, w);
  if (w.air) w.air->begin(team, w.smoothing_length, s);
  evaluate(team, p, s, w);
  measure_shear_rate(team, s, w);
}

void derive(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  if (s.gate_time >= 0) w.open_gates(s.time - s.gate_time);
  measure(team, s, w);
  w.sweep.find_neighbours(team, s.list_position, s.list_smoothing_length);
  evaluate(team, p, s, w);
}

double time_step(ThreadTeam& team, const Parameters& p, const State& s, const Workspace& w) {
  if (p.integration.step) return *p.integration.step;
  const double least = reduce(
      team, s.position.size(), std::numeric_limits<double>::infinity(),
      [&](std::size_t i) { return w.smoothing_length[i]; }, [](double a, double b) { return std::min(a, b); });
  return p.integration.courant * least / w.sound_speed;
}

NumericalError::Report step_limit(const Parameters& p, const State& s, const Workspace& w) {
  const auto least = std::min_element(w.smoothing_length.begin(), w.smoothing_length.end());
  const double of_grains = p.integration.step.value_or(p.integration.courant * *least / w.sound_speed);
  if (w.air && s.last_step < 0.5 * of_grains) return w.air->step_limit(s);
  const auto i = static_cast<std::size_t>(least - w.smoothing_length.begin());
  const Vector3& x = s.position[i];
  NumericalError::Report report{};
  report.term =
      p.integration.step
          ? "integration.step"
          : fmt::format("Courant number of the grains, where they are densest, at {:.4g} kg/m3", s.density[i]);
  report.place = fmt::format("particle {} at ({:.6g}, {:.6g}, {:.6g}) m", s.identity[i], x.x, x.y, x.z);
  report.advice = "a stiffer law of the grains, a larger sph.viscosity_alpha";
  return report;
}

void advance(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  double dt = time_step(team, p, s, w);
  if (w.air) dt = w.air->advance(team, w.smoothing_length, dt, s);
  p.integration.method == Method::runge_kutta ? runge_kutta(team, p, s, w, dt) : leapfrog(team, p, s, w, dt);
  turn_back(team, w.material, w.sweep.neighbourhood().domain(), w.position, s);
  damp(team, p, s, dt);
  s.time += dt;
  s.last_step = dt;
  ++s.step;
  check_possible(team, p, s, w, dt);
  look_at_phase(team, p, s, w);
  measure(team, s, w);
  if (!w.sweep.neighbourhood().holds(team, s.position, w.smoothing_length)) find_neighbours(team, p, s, w);
  evaluate(team, p, s, w);
  measure_shear_rate(team, s, w);
}

}  // namespace talus::continuum
