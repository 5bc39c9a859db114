// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "models/cloud/parameters.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/runge_kutta.hpp"

namespace talus::cloud {

namespace {

constexpr double stiffness_margin = 1.1;  // on the measured rate, which is a lower bound
constexpr int steps_between_estimates = 5;
constexpr int steps_between_sorts = 16;
constexpr double min_step_over_max = 1e-6;

void sort_at_intervals(ThreadTeam& team, const Parameters& p, State& state, Workspace& work);
double max_rate(const Parameters& p, const State& state, double max_overlap);
bool is_acceptable(const Parameters& p, const State& state, const Workspace& work, const Trial& trial, double step,
                   double overlap_before);
void accept(ThreadTeam& team, const Parameters& p, State& state, Workspace& work, const Trial& trial, double step);
double max_step(const Parameters& p, const Workspace& work);

}  // namespace

/// On entry and exit velocity, contact_force and overlap belong to position: the velocities at the end of a step start
/// the next one, and decide whether this one is accepted.
void advance(ThreadTeam& team, const Parameters& p, State& state, Workspace& work) {
  const double overlap_before = *std::max_element(state.overlap.begin(), state.overlap.end());
  sort_at_intervals(team, p, state, work);
  if (state.step % steps_between_estimates == 0 && p.contact.enabled) estimate_stiffness(team, p, state, work, 3);
  double step = std::min(state.next_step, max_step(p, work));
  while (true) {
    const double rate = max_rate(p, state, overlap_before);
    if (rate > 0) step = std::min(step, max_stable_step(p, rate));
    const Trial trial = try_step(team, p, state, work, step, rate);
    if (is_acceptable(p, state, work, trial, step, overlap_before)) return accept(team, p, state, work, trial, step);
    ++state.rejected_steps;
    step *= 0.5;
    estimate_stiffness(team, p, state, work, 3);
  }
}

namespace {

double max_step(const Parameters& p, const Workspace& work) {
  return p.integration.max_step * work.scales.stokes_time;
}

void keep_derived(State& state, Workspace& work) {
  state.velocity.swap(work.trial_velocity);
  state.contact_force.assign(work.velocities.contact_force().begin(), work.velocities.contact_force().end());
  state.overlap.assign(work.velocities.overlap().begin(), work.velocities.overlap().end());
}

void sort_for_packing(const Parameters& p, State& state, Workspace& work) {
  const auto order = spatial_order(state.position, 4 * p.particles.radius);
  state.spatial_order.assign(order.begin(), order.end());
  state.sum_cutoff = work.velocities.choose_sum(state.position);
  work.velocities.arrange_sum(state.spatial_order, state.sum_cutoff);
}

void sort_at_intervals(ThreadTeam& team, const Parameters& p, State& state, Workspace& work) {
  if (state.step % steps_between_sorts != 0 || state.step == 0) return;
  sort_for_packing(p, state, work);
  derive(team, state, work);
  ++state.evaluations;
}

std::string place_of(const State& state, std::size_t grain) {
  const Vector3& x = state.position[grain];
  return fmt::format("grain {} at ({:.6g}, {:.6g}, {:.6g}) m", grain, x.x, x.y, x.z);
}

[[noreturn]] void give_up(const Parameters& p, const State& state, const Workspace& work, bool finite,
                          double max_overlap) {
  NumericalError::Report report{
      .what = {}, .term = {}, .place = {}, .step = state.step, .time = state.time, .advice = {}};
  std::size_t worst = 0;
  if (finite) {
    const auto overlap = work.velocities.overlap();
    worst = static_cast<std::size_t>(std::max_element(overlap.begin(), overlap.end()) - overlap.begin());
    report.what = fmt::format("the largest overlap is {:.3g} radii", max_overlap / p.particles.radius);
    report.term = "contact force, Eq. 2";
    report.advice =
        "a larger contact.stiffness (overlaps grow like the square root of the number of grains), or a larger "
        "integration.max_overlap";
  } else {
    // One force that is not finite leaves no velocity finite: it comes first.
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
                           : fmt::format("a grain moves by more than {:g} radii in the shortest step", max_move);
    report.term = contact ? "contact force, Eq. 2" : "velocity induced by the other grains, Eq. 3";
    report.advice = "no two grains at one place at the start, a smaller integration.max_step";
  }
  report.place = place_of(state, worst);
  throw NumericalError(report);
}

/// The length of the next step over this one's. \param error over what is allowed
double growth(double error, int order) {
  const double tiny = 1e-4;  // what is below asks for the largest growth anyway
  const double root = order == 2 ? std::sqrt(std::max(error, tiny)) : std::pow(std::max(error, tiny), 1.0 / order);
  return std::clamp(0.8 / root, 0.5, 1.5);
}

/// That a step must be stable with, 1/s. The pair's error shows when grains come to touch: until they do, none is.
double max_rate(const Parameters& p, const State& state, double max_overlap) {
  if (p.integration.method == Method::dormand_prince && !(max_overlap > 0)) return 0;
  return std::max(stiffness_margin * state.spectral_radius, contact_rate(p));
}

/// The error over what is allowed.
double share_of_tolerance(const Parameters& p, const Trial& trial) {
  return trial.error / (p.integration.tolerance * p.particles.radius);
}

/// A step that is as short as the shortest stands, whatever its error.
/// \throws NumericalError for one that cannot, though it is as short
bool is_acceptable(const Parameters& p, const State& state, const Workspace& work, const Trial& trial, double step,
                   double overlap_before) {
  const double a = p.particles.radius;
  const bool at_least = step < min_step_over_max * max_step(p, work);
  const bool overlapped = trial.overlap > p.integration.max_overlap * a;
  if ((!trial.finite || overlapped) && at_least) give_up(p, state, work, trial.finite, trial.overlap);
  const bool grew = trial.overlap > overlap_before + p.integration.overlap_growth * a;
  return trial.finite && !overlapped && ((share_of_tolerance(p, trial) <= 1 && !grew) || at_least);
}

void accept(ThreadTeam& team, const Parameters& p, State& state, Workspace& work, const Trial& trial, double step) {
  for_each(team, state.position.size(), [&](std::size_t i) {
    state.increment[i] = work.latest[i] - state.position[i];
    state.position[i] = work.latest[i];
  });
  keep_derived(state, work);
  state.time += step;
  state.last_step = step;
  state.stages = trial.stages;
  ++state.step;
  state.next_step = std::min(max_step(p, work), step * growth(share_of_tolerance(p, trial), trial.order));
}

/// Steps as short as the shortest are never refused: with such contacts no error would be held, nor the run end.
void check_stiffness(const Parameters& p, const State& state, const Workspace& work) {
  const double share = max_stable_step(p, contact_rate(p)) / max_step(p, work);  // infinite without contacts
  if (share >= min_step_over_max) return;
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
  const double rate = max_rate(p, state, *std::max_element(state.overlap.begin(), state.overlap.end()));
  NumericalError::Report report{};
  if (rate > 0 && state.last_step > 0.9 * max_stable_step(p, rate)) {
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

Workspace::Workspace(const Parameters& parameters, const State& state, const Ranks& ranks)
    : velocities(parameters, state.radius, ranks),
      scales(cloud::scales(parameters)),
      latest(state.position.size()),
      before(state.position.size()),
      trial_velocity(state.position.size()) {
  if (parameters.integration.method == Method::dormand_prince)
    rates.assign(dormand_prince::stages - 2, std::vector<Vector3>(state.position.size()));
}

void derive(ThreadTeam& team, State& state, Workspace& work) {
  state.velocity.resize(state.position.size());
  work.velocities.arrange_sum(state.spatial_order, state.sum_cutoff);
  work.velocities(team, state.position, work.trial_velocity);
  keep_derived(state, work);
}

void begin(ThreadTeam& team, const Parameters& p, State& state, Workspace& work) {
  check_stiffness(p, state, work);
  sort_for_packing(p, state, work);
  derive(team, state, work);
  ++state.evaluations;
  work.trial_velocity = state.velocity;
  if (!all_finite(team, state.velocity)) give_up(p, state, work, false, 0);
  state.increment.assign(state.position.size(), Vector3{});
  state.next_step = 0.1 * max_step(p, work);
  estimate_stiffness(team, p, state, work, 20);
}

}  // namespace talus::cloud
