// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/ranks_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/model.hpp"
#include "models/continuum/setup/forecast.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

// Measured on two cores shared with other programs, waiting included (docs/design/ranks.md).
constexpr double of_copy = 450e-9;  // s a step: messages, migration, halo
// Assumed of an ordinary network.
constexpr double of_message_to_all = 3e-6;   // s, for each doubling of the processes; two a step
constexpr double of_deposited_cell = 30e-9;  // s a step of the air: 32 bytes to all
constexpr double of_shared_air = 2e-3;       // s a step of the air: some 200 messages
constexpr double uneven = 1.05;              // the largest work over the mean
constexpr double libraries = 47e6;           // of talus-mpi, bytes
constexpr double of_particle = 1250;         // bytes

PartOfBed largest_part(std::array<double, 3> sides, std::array<int, 3> cuts, int parts, double reach) {
  if (parts == 1) {
    double all = 1, owned = 1;
    for (std::size_t a = 0; a < 3; ++a) owned *= sides[a], all *= sides[a] + reach * cuts[a];
    return {owned, all - owned};
  }
  const auto longest = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  const double whole = sides[longest];
  const int low = cuts[longest], half = parts / 2;
  PartOfBed largest;
  for (const int part : {half, parts - half}) {
    sides[longest] = whole * part / parts;
    // A part in the middle has others on both of its sides.
    cuts[longest] = std::min(2, low + 1);
    const PartOfBed found = largest_part(sides, cuts, part, reach);
    if (found.owned + found.copies > largest.owned + largest.copies) largest = found;
  }
  return largest;
}

}  // namespace

PartOfBed largest_part(const std::array<double, 3>& sides, int parts, double reach) {
  return largest_part(sides, {}, parts, reach);
}

AirOfStep air_of_step(const continuum::Setup& setup, ThreadTeam& team) {
  if (!setup.given.air.enabled) return {};
  constexpr double most = 8000, steps = 40;
  continuum::Continuum model(std::make_shared<continuum::Setup>(continuum::sample(setup, most)), team);
  model.begin(team);
  for (int n = 0; n < steps; ++n) model.advance(team);
  const continuum::AirAround& air = model.state().air;
  return {model.time_of_steps().air / steps / static_cast<double>(air.grid.cells()),
          static_cast<double>(air.steps) / steps};
}

Lines forecast_on_ranks(const continuum::Setup& setup, double end, const AirOfStep& air, double step, int ranks) {
  const continuum::Forecast f = continuum::forecast(setup, end);
  const continuum::Parameters& p = setup.given;
  // The bed's lattice with as many particles as there are.
  std::array<double, 3> sides{};
  const double fill = std::cbrt(f.particles / std::max(1.0, setup.lattice.positions()));
  for (std::size_t a = 0; a < 3; ++a)
    sides[a] = fill * static_cast<double>(std::max<std::int64_t>(1, setup.lattice.count[a]));
  const double reach =
      (sph::support * setup.smoothing_length + 0.5 * p.integration.skin * p.bed.spacing) / p.bed.spacing;
  const PartOfBed part = largest_part(sides, ranks, reach);

  const double of_air = std::min(0.99 * step, air.seconds * f.cells);
  const bool is_shared = of_air > 0 && continuum::is_air_shared(continuum::air_grid(p));
  const double of_deposits = of_deposited_cell * f.cells / (is_shared ? ranks : 1);
  const double air_on_each =
      (is_shared ? of_air / ranks + of_shared_air * air.deposits : of_air) + of_deposits * air.deposits;
  const double on_each =
      air_on_each + uneven * (step - of_air) / ranks + of_copy * part.copies + 2 * of_message_to_all * std::log2(ranks);
  const double efficiency = step / (ranks * on_each);
  const double least = f.settling_steps + f.flow_steps, most = f.max_settling_steps + f.flow_steps;
  // Every process has the vessel.
  const double memory =
      libraries + of_particle * (part.owned + part.copies) + 900 * f.cells + 350 * f.wall_points + 400 * f.triangles;
  Lines lines = {{"particles", fmt::format("{:.3g} on each, with copies of {:.3g} others on the largest ({:.0f} %)",
                                           f.particles / ranks, part.copies, 100 * part.copies / part.owned)},
                 {"step", fmt::format("{:.3g} ms in place of {:.3g} ms on one process: efficiency {:.2f}",
                                      1e3 * on_each, 1e3 * step, efficiency)},
                 {"time", run::format_seconds(least * on_each) +
                              (most > least ? " to " + run::format_seconds(most * on_each) : std::string())},
                 {"memory", fmt::format("{:.0f} MB on each, {:.3g} MB in all", 1e-6 * memory, 1e-6 * ranks * memory)}};
  if (is_shared)
    lines.emplace_back("air", fmt::format("shared: {:.3g} ms of a step on each, {:.3g} ms on one process",
                                          1e3 * air_on_each, 1e3 * of_air));
  else if (of_air > 0)
    lines.emplace_back("air", fmt::format("every process computes all of it, {:.3g} ms of a step: it pays up to some "
                                          "{:.0f} processes, on which the grains take as long",
                                          1e3 * of_air, std::max(1.0, std::ceil((step - of_air) / of_air))));
  return lines;
}

}  // namespace talus::app
