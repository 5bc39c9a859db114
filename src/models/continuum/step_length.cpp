// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "models/continuum/step.hpp"

namespace talus::continuum {

namespace {

/// In a step no particle within the box moves farther than this, in spacings: faster ones would reach what the lists
/// of neighbours do not hold, and pass through each other.
constexpr double max_advance = 0.25;

/// Of the particles of this process.
GrainLimits limits_of_grains(ThreadTeam& team, const State& s, const Workspace& w) {
  return accumulate(
      team, w.smoothing_length.size(), GrainLimits{},
      [&](std::size_t i, GrainLimits& limits) {
        if (!w.share.owns(i)) return;
        limits.min_smoothing_length = std::min(limits.min_smoothing_length, w.smoothing_length[i]);
        const double square = dot(s.velocity[i], s.velocity[i]);
        if (square > limits.max_square_speed && w.boundary.domain().box().contains(s.position[i]))
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
double step_of_grains(const Setup& setup, const GrainLimits& limits, const Workspace& w, std::size_t particles) {
  const Parameters& p = setup.given;
  if (p.integration.step) return *p.integration.step;
  if (particles == 0) return p.integration.courant * w.pairs.smoothing_length(setup.density) / setup.sound_speed;
  return std::min(p.integration.courant * limits.min_smoothing_length / setup.sound_speed, step_of_speed(p, limits));
}

}  // namespace

GrainLimits joined_limits(ThreadTeam& team, const State& s, const Workspace& w, bool& vote) {
  const GrainLimits here = limits_of_grains(team, s, w);
  Votes votes{.least = {here.min_smoothing_length, vote ? 1.0 : 0.0}, .largest = {here.max_square_speed}, .sum = {}};
  w.share.vote(votes);
  vote = votes.least[1] > 0;
  return {votes.least[0], votes.largest[0]};
}

double step_length(ThreadTeam& team, const Setup& setup, const State& s, Workspace& w) {
  const std::optional<GrainLimits> known = std::exchange(w.limits, std::nullopt);
  if (w.air && !w.air->is_due(s)) return s.last_step;
  bool no_vote = true;
  const GrainLimits limits = known ? *known : joined_limits(team, s, w, no_vote);
  const double of_grains = step_of_grains(setup, limits, w, w.share.of_all(s.position.size()));
  return w.air ? std::min(of_grains, w.air->max_step()) : of_grains;
}

NumericalError::Report step_limit(const Setup& setup, const State& s, const Workspace& w) {
  const Parameters& p = setup.given;
  const std::size_t count = w.share.of_all(s.position.size());
  if (count == 0) {
    NumericalError::Report report{};
    report.term = "step without particles", report.place = "an empty vessel", report.advice = "integration.courant";
    return report;
  }
  // That of the densest particle, or of the fastest within the box.
  std::optional<std::size_t> densest, fastest;
  GrainLimits here;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (!w.share.owns(i)) continue;
    const double square = dot(s.velocity[i], s.velocity[i]);
    if (w.smoothing_length[i] < here.min_smoothing_length)
      here.min_smoothing_length = w.smoothing_length[i], densest = i;
    if (square > here.max_square_speed && w.boundary.domain().box().contains(s.position[i]))
      here.max_square_speed = square, fastest = i;
  }
  Votes votes{.least = {here.min_smoothing_length}, .largest = {here.max_square_speed}, .sum = {}};
  w.share.vote(votes);
  const GrainLimits limits{votes.least[0], votes.largest[0]};
  if (here.min_smoothing_length > limits.min_smoothing_length) densest.reset();
  if (here.max_square_speed < limits.max_square_speed) fastest.reset();
  const double of_grains = step_of_grains(setup, limits, w, count);
  if (w.air && s.last_step < 0.5 * of_grains) return w.air->step_limit(s);
  const bool by_speed = !(of_grains < step_of_speed(p, limits));
  return w.share.report_of_first(by_speed ? fastest : densest, [&](std::size_t i) {
    NumericalError::Report report{};
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
  });
}

}  // namespace talus::continuum
