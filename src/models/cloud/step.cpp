// SPDX-License-Identifier: Apache-2.0
/// The stages of a step: (1) at intervals the stiffest rate is estimated and the grains are sorted; (2) the Chebyshev
/// stages that this rate and the step size require, or those of Dormand and Prince; (3) the velocities at the new
/// positions, which start the next step and decide whether this one is accepted; (4) if not, it is repeated with half
/// the step size. On entry and exit: velocity, contact_force and overlap belong to position.
#include "models/cloud/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "models/cloud/stability.hpp"
#include "models/cloud/stiffness.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/chebyshev.hpp"
#include "numerics/dormand_prince.hpp"

namespace talus::cloud {

namespace {

constexpr double stiffness_margin = 1.1;  // on the measured rate, which is a lower bound
constexpr int steps_between_estimates = 5;
constexpr int steps_between_sorts = 16;
constexpr double least_step_over_largest = 1e-6;
constexpr double farthest_move = 1e4;  // of a grain within a step, in mean radii: the error control rejects less

double root_mean_square(ThreadTeam& team, std::size_t count, auto&& vector) {
  const double sum = reduce(
      team, count, 0.0,
      [&](std::size_t i) {
        const Vector3 v = vector(i);
        return dot(v, v);
      },
      [](double a, double b) { return a + b; });
  return std::sqrt(sum / static_cast<double>(count));
}

double error_of_first_order(ThreadTeam& team, const State& state, const Workspace& work, double step,
                            double second_order) {
  if (state.last_step == 0) return 0;
  // A first-order step errs by |1/2 - c_2| h^2 x''; the change of the displacement from one step to the next shows
  // h (h + h_last)/2 x'', and unlike differences of velocities it does not see the stiff modes that the stages have
  // damped.
  const double ratio = step / state.last_step;
  const double factor = std::abs(0.5 - second_order) * 2 * step / (step + state.last_step);
  return factor * root_mean_square(team, state.position.size(), [&](std::size_t i) {
           return work.latest[i] - state.position[i] - ratio * state.increment[i];
         });
}

/// Of the embedded solution: one order lower than the step itself.
double error_of_dormand_prince(ThreadTeam& team, const State& state, const Workspace& work, double step) {
  return step * root_mean_square(team, state.position.size(), [&](std::size_t i) {
           Vector3 sum = dormand_prince::error.front() * state.velocity[i];
           for (std::size_t s = 1; s + 1 < dormand_prince::stages; ++s)
             sum += dormand_prince::error[s] * work.rates[s - 1][i];
           return sum + dormand_prince::error.back() * work.trial_velocity[i];
         });
}

bool all_finite(ThreadTeam& team, std::span<const Vector3> v) {
  return reduce(
      team, v.size(), true, [&](std::size_t i) { return std::isfinite(v[i].x + v[i].y + v[i].z); },
      [](bool a, bool b) { return a && b; });
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

void keep_derived(State& state, Workspace& work) {
  state.velocity.swap(work.trial_velocity);
  state.contact_force.assign(work.velocities.contact_force().begin(), work.velocities.contact_force().end());
  state.overlap.assign(work.velocities.overlap().begin(), work.velocities.overlap().end());
}

void sort_for_packing(const Parameters& p, State& state, Workspace& work) {
  const auto order = spatial_order(state.position, 4 * p.particles.radius);
  state.spatial_order.assign(order.begin(), order.end());
  work.velocities.reorder(state.spatial_order);
}

std::string place_of(const State& state, std::size_t grain) {
  const Vector3& x = state.position[grain];
  return fmt::format("grain {} at ({:.6g}, {:.6g}, {:.6g}) m", grain, x.x, x.y, x.z);
}

[[noreturn]] void give_up(const Parameters& p, const State& state, const Workspace& work, bool finite,
                          double largest_overlap) {
  NumericalError::Report report{
      .what = {}, .term = {}, .place = {}, .step = state.step, .time = state.time, .advice = {}};
  std::size_t worst = 0;
  if (finite) {
    const auto overlap = work.velocities.overlap();
    worst = static_cast<std::size_t>(std::max_element(overlap.begin(), overlap.end()) - overlap.begin());
    report.what = fmt::format("the largest overlap is {:.3g} radii", largest_overlap / p.particles.radius);
    report.term = "contact force, Eq. 2";
    report.advice =
        "a larger contact.stiffness (overlaps grow like the square root of the number of grains), or a larger "
        "integration.largest_overlap";
  } else {
    // A single force that is not finite makes all velocities so: it is checked first.
    const auto forces = work.velocities.contact_force();
    const auto not_finite = [](const Vector3& v) { return !std::isfinite(v.x + v.y + v.z); };
    const auto broken_force = std::find_if(forces.begin(), forces.end(), not_finite);
    const bool contact = broken_force != forces.end();
    const auto broken = contact ? work.trial_velocity.begin() + (broken_force - forces.begin())
                                : std::find_if(work.trial_velocity.begin(), work.trial_velocity.end(), not_finite);
    const bool infinite = broken != work.trial_velocity.end();
    const auto fastest = std::max_element(work.trial_velocity.begin(), work.trial_velocity.end(),
                                          [](const Vector3& u, const Vector3& v) { return dot(u, u) < dot(v, v); });
    worst = static_cast<std::size_t>((infinite ? broken : fastest) - work.trial_velocity.begin());
    report.what = infinite ? "the velocity is not finite"
                           : fmt::format("a grain moves by more than {:g} radii in the shortest step", farthest_move);
    report.term = contact ? "contact force, Eq. 2" : "velocity induced by the other grains, Eq. 3";
    report.advice = "no two grains at one place at the start, a smaller integration.largest_step";
  }
  report.place = place_of(state, worst);
  throw NumericalError(report);
}

/// A trial step: its result in the workspace, and whether it is accepted.
struct Trial {
  bool finite = false;
  std::uint64_t stages = 0;
  double error = 0;    ///< root mean square of the local error, m
  double overlap = 0;  ///< largest, m
  int order = 2;       ///< the local error goes as the step to this power
};

/// \param rate of the stiffest motion, 1/s
Trial try_step(ThreadTeam& team, const Parameters& p, State& state, Workspace& work, double step, double rate) {
  const bool pair = p.integration.method == Method::dormand_prince;
  const double farthest = farthest_move * p.particles.radius;
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
  trial.overlap = work.velocities.largest_overlap();
  trial.error = pair ? error_of_dormand_prince(team, state, work, step)
                     : error_of_first_order(team, state, work, step, scheme.second_order);
  return trial;
}

/// The length of the next step over this one's. \param error over what is allowed
double growth(double error, int order) {
  const double tiny = 1e-4;  // smaller errors give the largest growth anyway
  const double root = order == 2 ? std::sqrt(std::max(error, tiny)) : std::pow(std::max(error, tiny), 1.0 / order);
  return std::clamp(0.8 / root, 0.5, 1.5);
}

/// The rate for which a step must be stable, 1/s. The error of the pair detects new contacts: before them, no limit is
/// needed.
double stiffest_rate(const Parameters& p, const State& state, double largest_overlap) {
  if (p.integration.method == Method::dormand_prince && !(largest_overlap > 0)) return 0;
  return std::max(stiffness_margin * state.spectral_radius, contact_rate(p));
}

/// Steps of the minimum size are always accepted: with such contacts the tolerance could not be met, and the run would
/// not end.
void check_stiffness(const Parameters& p, const State& state, double largest_step) {
  const double share = longest_stable_step(p, contact_rate(p)) / largest_step;  // infinite without contacts
  if (share >= least_step_over_largest) return;
  throw NumericalError({.what = fmt::format("the longest stable step is {:.2g} of the largest", share),
                        .term = "contact force, Eq. 2",
                        .place = "every contact",
                        .step = state.step,
                        .time = state.time,
                        .advice = "a smaller contact.stiffness"});
}

}  // namespace

NumericalError::Report step_limit(const Parameters& p, const State& state) {
  const auto most = [](const auto& column, auto&& less) {
    return static_cast<std::size_t>(std::max_element(column.begin(), column.end(), less) - column.begin());
  };
  const auto shorter = [](const Vector3& u, const Vector3& v) { return dot(u, u) < dot(v, v); };
  const double rate = stiffest_rate(p, state, *std::max_element(state.overlap.begin(), state.overlap.end()));
  NumericalError::Report report{};
  if (rate > 0 && state.last_step > 0.9 * longest_stable_step(p, rate)) {
    report.term = fmt::format("stability of the contacts, whose stiffest rate is {:.3g} 1/s, Eq. 2", rate);
    report.place = state.stiff_mode.empty() ? "every contact" : place_of(state, most(state.stiff_mode, shorter));
    report.advice = "a smaller contact.stiffness";
  } else {
    const std::size_t tightest = most(state.overlap, std::less<>());
    const bool touches = state.overlap[tightest] > 0;
    report.term = "error of a step or growth of an overlap, Eq. 4a";
    report.place = place_of(state, touches ? tightest : most(state.velocity, shorter));
    report.advice = "a larger contact.stiffness, a larger integration.tolerance or integration.overlap_growth";
  }
  return report;
}

Workspace::Workspace(const Parameters& parameters, const State& state)
    : velocities(parameters, state.radius),
      scales(cloud::scales(parameters)),
      latest(state.position.size()),
      before(state.position.size()),
      trial_velocity(state.position.size()) {
  if (parameters.integration.method == Method::dormand_prince)
    rates.assign(dormand_prince::stages - 2, std::vector<Vector3>(state.position.size()));
}

void derive(ThreadTeam& team, State& state, Workspace& work) {
  state.velocity.resize(state.position.size());
  work.velocities.reorder(state.spatial_order);
  work.velocities(team, state.position, work.trial_velocity);
  keep_derived(state, work);
}

void begin(ThreadTeam& team, const Parameters& p, State& state, Workspace& work) {
  const double largest_step = p.integration.largest_step * work.scales.stokes_time;
  check_stiffness(p, state, largest_step);
  sort_for_packing(p, state, work);
  derive(team, state, work);
  ++state.evaluations;
  work.trial_velocity = state.velocity;
  if (!all_finite(team, state.velocity)) give_up(p, state, work, false, 0);
  state.increment.assign(state.position.size(), Vector3{});
  state.next_step = 0.1 * largest_step;
  estimate_stiffness(team, p, state, work, 20);
}

void advance(ThreadTeam& team, const Parameters& p, State& state, Workspace& work) {
  const double a = p.particles.radius;
  const double largest_step = p.integration.largest_step * work.scales.stokes_time;
  const double overlap_before = *std::max_element(state.overlap.begin(), state.overlap.end());

  if (state.step % steps_between_sorts == 0 && state.step > 0) {
    sort_for_packing(p, state, work);
    derive(team, state, work);
    ++state.evaluations;
  }
  if (state.step % steps_between_estimates == 0 && p.contact.enabled) estimate_stiffness(team, p, state, work, 3);

  double step = std::min(state.next_step, largest_step);
  while (true) {
    const double rate = stiffest_rate(p, state, overlap_before);
    if (rate > 0) step = std::min(step, longest_stable_step(p, rate));
    const Trial trial = try_step(team, p, state, work, step, rate);
    const double overlap = trial.overlap, error = trial.error / (p.integration.tolerance * a);
    const bool finite = trial.finite;
    const bool at_least = step < least_step_over_largest * largest_step;
    const bool overlapped = overlap > p.integration.largest_overlap * a;
    if ((!finite || overlapped) && at_least) give_up(p, state, work, finite, overlap);
    const bool grew = overlap > overlap_before + p.integration.overlap_growth * a;
    if (finite && !overlapped && ((error <= 1 && !grew) || at_least)) {
      for_each(team, state.position.size(), [&](std::size_t i) {
        state.increment[i] = work.latest[i] - state.position[i];
        state.position[i] = work.latest[i];
      });
      keep_derived(state, work);
      state.time += step;
      state.last_step = step;
      state.stages = trial.stages;
      ++state.step;
      state.next_step = std::min(largest_step, step * growth(error, trial.order));
      return;
    }
    ++state.rejected_steps;
    step *= 0.5;
    estimate_stiffness(team, p, state, work, 3);
  }
}

}  // namespace talus::cloud
