// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/system.hpp"
#include "models/cloud/mobility_sum.hpp"

namespace talus::cloud {

namespace {

double max_speed(const State& state) {
  double speed = 0;
  for (const Vector3& v : state.velocity) speed = std::max(speed, norm(v));
  return speed;
}

double max_overlap(const State& state) {
  return state.overlap.empty() ? 0 : *std::max_element(state.overlap.begin(), state.overlap.end());
}

/// How the sum over pairs was computed at the end of the run, where there was a choice.
std::optional<RegimeLine> sum_line(const Parameters& p, const State& state) {
  const SpectralAccuracy* const accuracy = spectral_accuracy_of(p, static_cast<double>(state.position.size()));
  if (!accuracy) return std::nullopt;
  if (!(state.sum_cutoff > 0))
    return RegimeLine{"sum over pairs", "direct", "cheaper at the end of the run, fluid.sum"};
  return RegimeLine{
      "sum over pairs", fmt::format("spectral, error {:.0e}", accuracy->error),
      fmt::format("of the root mean square; of a pair at most {:.2g}/(8 pi mu max(r, r_c)); r_c {:.3g} a_p, grid "
                  "{:.3g} a_p, splines over {} points, {}",
                  accuracy->pair_error, state.sum_cutoff / p.particles.radius,
                  state.sum_cutoff / accuracy->nodes / p.particles.radius, accuracy->points,
                  accuracy->single ? "single precision" : "double precision")};
}

}  // namespace

Cloud::Cloud(const Parameters& parameters, Grains grains, const Ranks& ranks) : ranks_(ranks), parameters_(parameters) {
  state_.position = std::move(grains.position);
  state_.radius = std::move(grains.radius);
}

void Cloud::begin(ThreadTeam& team) {
  workspace_.emplace(parameters_, state_, ranks_);
  const Stopwatch watch(seconds_);
  cloud::begin(team, parameters_, state_, *workspace_);
}

void Cloud::resume(ThreadTeam& team) {
  workspace_.emplace(parameters_, state_, ranks_);
  const Stopwatch watch(seconds_);
  derive(team, state_, *workspace_);
}

void Cloud::advance(ThreadTeam& team) {
  const Stopwatch watch(seconds_);
  cloud::advance(team, parameters_, state_, *workspace_);
}

void Cloud::gather() {
  const double messages = workspace_->velocities.sum().seconds_of_messages() / std::max(1e-9, seconds_);
  Votes votes{.least = {}, .largest = {}, .sum = {static_cast<std::uint64_t>(std::lround(1e6 * messages))}};
  ranks_.join(votes);
  account_ = fmt::format("{} processes: each has all grains; of a step messages take {:.1f} %", ranks_.size(),
                         1e-4 * static_cast<double>(votes.sum[0]) / ranks_.size());
}

NumericalError::Report Cloud::step_limit() const {
  return cloud::step_limit(parameters_, state_);
}

std::vector<NamedValue> Cloud::totals() const {
  double centre = 0;
  for (const Vector3& x : state_.position) centre += x.x;
  centre /= static_cast<double>(state_.position.size());
  return {{"step_size", "s", state_.last_step},
          {"stages", "1", static_cast<double>(state_.stages)},
          {"evaluations", "1", static_cast<double>(state_.evaluations)},
          {"spectral_radius", "1/s", state_.spectral_radius},
          {"overlap_max", "m", max_overlap(state_)},
          {"speed_max", "m/s", max_speed(state_)},
          {"centre_x", "m", centre}};
}

std::vector<RegimeLine> Cloud::regime(const RunRecord& record) const {
  const double a = parameters_.particles.radius;
  const double fastest = record.largest("speed_max") * parameters_.fluid.density * a / parameters_.fluid.viscosity;
  const double overlap = record.largest("overlap_max") / a;
  std::vector<RegimeLine> lines = regime_of_case(parameters_);
  if (const auto line = sum_line(parameters_, state_)) lines.push_back(*line);
  lines.push_back({"Reynolds number of the fastest grain", fmt::format("{:.3g}", fastest),
                   "the same at the largest speed of the run", fastest > 0.1});
  lines.push_back({"largest overlap", fmt::format("{:.3g} a_p", overlap),
                   "of the run, overlap_max; hard grains: a few hundredths at most", overlap > 0.1});
  return lines;
}

}  // namespace talus::cloud
