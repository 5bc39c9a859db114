// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_sum.hpp"
#include "base/random.hpp"
#include "models/cloud/stability.hpp"

namespace talus::cloud {

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
