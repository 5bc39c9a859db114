// SPDX-License-Identifier: Apache-2.0
/// The state of a sector in disorder, the whole circle of its copies, and sums over the neighbours in either.
#pragma once

#include <vector>

#include "base/random.hpp"
#include "models/continuum/cases.hpp"
#include "models/continuum/pairs/pair_sums.hpp"
#include "models/continuum/sector.hpp"
#include "models/continuum/setup/vessel.hpp"
#include "numerics/snapshot.hpp"

namespace talus::continuum {

/// Sums over neighbours of a state, in a domain.
struct Sums {
  ThreadTeam team{1};
  Domain domain;
  Surface vessel;
  SurfaceFields fields;
  PairSums pairs;
  Rates rates;

  Sums(const Parameters& p, const Domain& around, const State& s, bool walls)
      : domain(around),
        vessel(walls ? Boundary(p).vessel() : Surface()),
        fields(load_fields(Layout(p))),
        pairs(setup_with(p, 50), domain, vessel, &fields) {
    std::vector<double> h;
    for (std::size_t i = 0; i < s.density.size(); ++i) h.push_back(pairs.smoothing_length(s.density[i], s.ratios()[i]));
    const std::vector<double> margin(h.size());
    pairs.find_neighbours(team, s.position, h, margin, s.mass_ratio);
    pairs(team, {s.position, s.velocity, s.density, h, s.material, s.ratios()}, PairTerms::all, rates);
  }
};

/// The bed of a case in disorder: densities, velocities, stresses and rates of any size.
inline State disordered(const Parameters& p) {
  State s = initial_state(setup_of(p));
  Random random(7);
  const auto some = [&](double size) { return random.uniform(-size, size); };
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    s.position[i] += 0.1 * spacing * Vector3{some(1), some(1), some(1)};
    s.density[i] *= random.uniform(0.8, 1.1);
    s.velocity[i] = {some(1), some(1), some(1)};
    for (auto& column : s.material.stress) column[i] = some(1000);
    for (auto& column : s.lasting_rate)
      if (!column.empty()) column[i] = some(100);
  }
  return s;
}

/// The state of the whole circle, as a case without a sector has it.
inline State unfolded(const State& s, const Sector& sector) {
  const PointSet all = talus::whole_of(part_of(s, sector).view());
  const Snapshot view = all.view();
  State whole;
  whole.mass = s.mass;
  const auto copy = [](const auto& span) { return std::vector(span.begin(), span.end()); };
  whole.position = copy(view.positions()), whole.velocity = copy(view.vectors("velocity"));
  whole.density = copy(view.scalars("density"));
  if (!s.mass_ratio.empty()) whole.mass_ratio = copy(view.scalars("mass_ratio"));
  const char* const names[] = {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  for (std::size_t c = 0; c < 6; ++c) whole.material.stress[c] = copy(view.scalars(names[c]));
  return whole;
}

}  // namespace talus::continuum
