// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/exact_sum.hpp"
#include "base/random.hpp"
#include "models/cloud/parameters.hpp"
#include "models/cloud/step.hpp"
#include "numerics/runge_kutta.hpp"

namespace talus::cloud {

namespace {

double root_mean_square(ThreadTeam& team, std::size_t count, auto&& vector) {
  const double sum = exact_sum(team, count, [&](std::size_t i) {
    const Vector3 v = vector(i);
    return dot(v, v);
  });
  return std::sqrt(sum / static_cast<double>(count));
}

double error_of_first_order(ThreadTeam& team, const State& state, const Workspace& work, double step,
                            double second_order) {
  if (state.last_step == 0) return 0;
  // A first-order step errs by |1/2 - c_2| h^2 x''; the change of the displacement from one step to the next shows
  // h (h + h_last)/2 x'', and unlike differences of velocities it excludes the stiff modes that the stages have
  // damped.
  const double ratio = step / state.last_step;
  const double factor = std::abs(0.5 - second_order) * 2 * step / (step + state.last_step);
  return factor * root_mean_square(team, state.position.size(), [&](std::size_t i) {
           return work.latest[i] - state.position[i] - ratio * state.increment[i];
         });
}

/// Of the embedded solution: one order below what the step itself has.
double error_of_dormand_prince(ThreadTeam& team, const State& state, const Workspace& work, double step) {
  return step * root_mean_square(team, state.position.size(), [&](std::size_t i) {
           Vector3 sum = dormand_prince::error.front() * state.velocity[i];
           for (std::size_t s = 1; s + 1 < dormand_prince::stages; ++s)
             sum += dormand_prince::error[s] * work.rates[s - 1][i];
           return sum + dormand_prince::error.back() * work.trial_velocity[i];
         });
}

bool all_near(ThreadTeam& team, const std::vector<Vector3>& before, const std::vector<Vector3>& after, double limit) {
  return reduce(
      team, before.size(), true, [&](std::size_t i) { return norm(after[i] - before[i]) <= limit; },
      [](bool a, bool b) { return a && b; });
}

/// Takes the stages of a step; the result is in work.latest. \returns false as soon as a velocity is not finite or a
/// grain is farther than `farthest` from where it was
bool take_dormand_prince(ThreadTeam& team, State& state, Workspace& work, double step, double farthest) {
  for (std::size_t s = 1; s < dormand_prince::stages; ++s) {
    for_each(team, state.position.size(), [&](std::size_t i) {
      Vector3 sum = dormand_prince::weight[s].front() * state.velocity[i];
      for (std::size_t r = 1; r < s; ++r) sum += dormand_prince::weight[s][r] * work.rates[r - 1][i];
      work.latest[i] = state.position[i] + step * sum;
    });
    if (!all_near(team, state.position, work.latest, farthest)) return false;
    if (s + 1 == dormand_prince::stages) break;
    work.velocities(team, work.latest, work.trial_velocity);
    ++state.evaluations;
    if (!all_finite(team, work.trial_velocity)) return false;
    work.rates[s - 1].swap(work.trial_velocity);
  }
  return true;
}

/// The same with Chebyshev's.
bool take_chebyshev(ThreadTeam& team, State& state, Workspace& work, const ChebyshevStages& scheme, double step,
                    double farthest) {
  const std::size_t count = state.position.size();
  for_each(team, count, [&](std::size_t i) {
    work.before[i] = state.position[i];
    work.latest[i] = state.position[i] + (scheme.stages[0].rate * step) * state.velocity[i];
  });
  for (std::size_t j = 1; j < scheme.stages.size(); ++j) {
    const ChebyshevStages::Stage stage = scheme.stages[j];
    if (!all_near(team, state.position, work.latest, farthest)) return false;
    work.velocities(team, work.latest, work.trial_velocity);
    ++state.evaluations;
    if (!all_finite(team, work.trial_velocity)) return false;
    for_each(team, count, [&](std::size_t i) {
      const Vector3 next = stage.previous * work.latest[i] + stage.before_previous * work.before[i] +
                           (stage.rate * step) * work.trial_velocity[i];
      work.before[i] = work.latest[i];
      work.latest[i] = next;
    });
  }
  return all_near(team, state.position, work.latest, farthest);
}

}  // namespace

bool all_finite(ThreadTeam& team, std::span<const Vector3> v) {
  return reduce(
      team, v.size(), true, [&](std::size_t i) { return std::isfinite(v[i].x + v[i].y + v[i].z); },
      [](bool a, bool b) { return a && b; });
}

Trial try_step(ThreadTeam& team, const Parameters& p, State& state, Workspace& work, double step, double rate) {
  const bool pair = p.integration.method == Method::dormand_prince;
  const double farthest = max_move * p.particles.radius;
  ChebyshevStages scheme;
  if (!pair)
    scheme = chebyshev_stages(p.integration.method == Method::euler ? 1 : stages_for(step * rate, stage_damping),
                              stage_damping);
  Trial trial{.stages = pair ? dormand_prince::stages - 1 : scheme.stages.size(),
              .order = pair ? dormand_prince::order : 2};
  if (!(pair ? take_dormand_prince(team, state, work, step, farthest)
             : take_chebyshev(team, state, work, scheme, step, farthest)))
    return trial;
  work.velocities(team, work.latest, work.trial_velocity);
  ++state.evaluations;
  trial.finite = all_finite(team, work.trial_velocity);
  trial.overlap = work.velocities.max_overlap();
  trial.error = pair ? error_of_dormand_prince(team, state, work, step)
                     : error_of_first_order(team, state, work, step, scheme.second_order);
  return trial;
}

namespace {

double length(ThreadTeam& team, const std::vector<Vector3>& v) {
  return std::sqrt(exact_sum(team, v.size(), [&](std::size_t i) { return dot(v[i], v[i]); }));
}

}  // namespace

void estimate_stiffness(ThreadTeam& team, const Parameters& p, State& state, Workspace& work, int sweeps) {
  const std::size_t count = state.position.size();
  // Root mean square displacement of the trial: far below an overlap, far above the rounding of the velocities.
  const bool single = state.sum_cutoff > 0 ? work.velocities.sum().accuracy()->single
                                           : p.fluid.precision == Precision::single_precision;
  const double amplitude = (single ? 1e-5 : 1e-6) * p.particles.radius * std::sqrt(double(count));
  if (state.spectral_radius < contact_rate(p) || state.stiff_mode.size() != count) {
    Random random(1);
    state.stiff_mode.resize(count);
    for (Vector3& v : state.stiff_mode)
      v = in_plane({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, p.motion);
    const double scale = length(team, state.stiff_mode);
    for (Vector3& v : state.stiff_mode) v = (1 / scale) * v;
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for_each(team, count, [&](std::size_t i) { work.latest[i] = state.position[i] + amplitude * state.stiff_mode[i]; });
    work.velocities(team, work.latest, work.trial_velocity);
    ++state.evaluations;
    for_each(team, count, [&](std::size_t i) { work.before[i] = work.trial_velocity[i] - state.velocity[i]; });
    const double size = length(team, work.before);
    if (!(size > 0) || !std::isfinite(size)) return;
    for_each(team, count, [&](std::size_t i) { state.stiff_mode[i] = (1 / size) * work.before[i]; });
    const double previous = state.spectral_radius;
    state.spectral_radius = size / amplitude;
    if (std::abs(state.spectral_radius - previous) < 0.02 * state.spectral_radius) return;
  }
}

}  // namespace talus::cloud
