// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/gas/atmosphere.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/exact_sum.hpp"
#include "numerics/grid/loops.hpp"

namespace talus::continuum {

namespace {

constexpr double random_close_packing = 0.64;  // of spheres: Scott & Kilgour, J. Phys. D 2, 863 (1969)

air::Parameters gas_of(const Parameters& p) {
  air::Parameters gas = p.air.gas;
  gas.grain_diameter = p.grains.diameter;
  gas.grain_density = p.grains.density;
  return gas;
}

}  // namespace

Atmosphere::Atmosphere(const Parameters& p, const Boundary& boundary, const Share& share)
    : boundary_(boundary),
      share_(share),
      openings_(boundary.openings()),
      grain_density_(p.grains.density),
      max_solid_fraction_(std::max(random_close_packing, p.bed.packing)),
      medium_(gas_of(p).medium()),
      deposition_(air_grid(p), boundary_.domain(), boundary_.vessel()),
      flow_(air_grid(p), gas_of(p), boundary_.domain().walls(), boundary_.vessel()),
      per_solid_volume_(air_grid(p).face_field()),
      slip_square_(air_grid(p).cell_field()) {}

void Atmosphere::advance(ThreadTeam& team, double dt, State& s) {
  if (is_due(s)) move_air(team, dt, s);
  --s.air.steps_left;
  s.air.impulse += dt * s.air.force;
}

void Atmosphere::take_grains(ThreadTeam& team, std::span<const double> smoothing_length, State& s) {
  AirAround& a = s.air;
  if (openings_ != boundary_.openings()) {
    openings_ = boundary_.openings();
    flow_.set_walls(boundary_.domain().walls(), boundary_.vessel());
  }
  for_each_cell(team, a.grid, [&](int, int, int, std::ptrdiff_t c) {
    a.excess[static_cast<std::size_t>(c)] += a.solids.fraction[static_cast<std::size_t>(c)];
  });
  deposit(team, smoothing_length, s);
  for_each_cell(team, a.grid, [&](int, int, int, std::ptrdiff_t c) {
    a.excess[static_cast<std::size_t>(c)] -= a.solids.fraction[static_cast<std::size_t>(c)];
  });
  const Stopwatch watch(share_.time().air);
  max_step_ = flow_.time_step(team, a.solids, a.flow);
}

void Atmosphere::move_air(ThreadTeam& team, double dt, State& s) {
  AirAround& a = s.air;
  a.steps_left = static_cast<std::uint64_t>(max_step_ / dt);
  const double duration = static_cast<double>(a.steps_left) * dt;
  std::optional<Stopwatch> watch(share_.time().air);
  try {
    flow_.advance(team, duration, a.solids, a.flow, per_solid_volume_);
    for (const auto& [cell, share] : overfull_)
      for (CellField& component : per_solid_volume_) component[cell] *= share;
  } catch (const NumericalError& error) {
    NumericalError::Report report = error.report();
    report.step = s.step, report.time = s.time;
    throw NumericalError(report);
  }
  flow_.add_outflow(team, duration, a.flow, a.excess);
  const double* pressure = a.flow.pressure.data();
  a.swing_max =
      std::max(a.swing_max, max_of_cells(team, a.grid, [&](std::ptrdiff_t c) { return std::abs(pressure[c]); }));
  watch.reset();
  received_.resize(s.position.size());
  deposition_.distribute(team, s.mass / grain_density_, per_solid_volume_, received_);
  for_each(team, received_.size(),
           [&](std::size_t i) { a.acceleration[i] = (1 / (s.mass * duration)) * received_[i]; });
  const FixedPoint point(s.impulse_unit / duration);
  FixedVector force = accumulate(
      team, received_.size(), FixedVector{},
      [&](std::size_t i, FixedVector& sum) { sum.add(point, s.mass * a.acceleration[i]); },
      [](FixedVector one, const FixedVector& other) { return one += other; });
  sum_up(share_.ranks(), std::span(&force, 1));
  a.force = force.value(point);
  ++a.steps;
  a.iterations = static_cast<std::uint64_t>(flow_.iterations());
  measure_slip(team, s);
}

void Atmosphere::deposit(ThreadTeam& team, std::span<const double> smoothing_length, State& s) {
  deposition_.find_weights(team, s.position, smoothing_length, share_.part().is_copy);
  deposition_.deposit(team, s.mass / grain_density_, s.velocity, s.air.solids.fraction, s.air.solids.flux);
  share_.ranks().add_up(s.air.solids.fraction);
  for (CellField& component : s.air.solids.flux) share_.ranks().add_up(component);
  if (!boundary_.vessel().is_empty()) leave_overfull(s.air.solids);
}

/// A cell whose centre is within the vessel has the grains of the cells next to it that the wall cuts, too. What is
/// more than grains can fill stands beyond the wall: the air meets the rest, as fast, and what it exchanges with that
/// goes to all of them.
void Atmosphere::leave_overfull(air::Solids& solids) {
  overfull_.clear();
  for (std::size_t c = 0; c < solids.fraction.size(); ++c) {
    double& fraction = solids.fraction[c];
    if (!(fraction > max_solid_fraction_)) continue;
    const double share = max_solid_fraction_ / fraction;
    overfull_.push_back({c, share});
    fraction = max_solid_fraction_;
    for (CellField& component : solids.flux) component[c] *= share;
  }
}

void Atmosphere::begin(ThreadTeam& team, std::span<const double> smoothing_length, State& s) {
  deposit(team, smoothing_length, s);
  flow_.begin(team, s.air.solids, s.air.flow);
}

/// The slip of each particle is the mean of its cells'.
void Atmosphere::measure_slip(ThreadTeam& team, State& s) {
  const AirAround& a = s.air;
  for_each_row(team, a.grid, a.grid.count, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
    auto& [x, y, z] = per_solid_volume_;
    air::find_slip_of_row(end - begin, flow_.cells_from(begin, a.solids, a.flow.velocity), x.data() + begin,
                          y.data() + begin, z.data() + begin, slip_square_.data() + begin);
  });
  const double reynolds_of_one = coupling::grain_reynolds(medium_, 1);
  const double slip = largest_of(share_.ranks(), deposition_.max_mean(team, per_solid_volume_, slip_square_,
                                                                      s.air.reynolds_max / reynolds_of_one));
  s.air.reynolds_max = std::max(s.air.reynolds_max, reynolds_of_one * slip);
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Number>
using InTurn = std::array<Number, turns_of_cells>;

}  // namespace

AirTotals totals_of_air(const AirAround& air) {
  InTurn<double> square{}, least, most;
  ExactSum excess;
  least.fill(infinity), most.fill(-infinity);
  for_each_air_cell(air, [&](std::size_t c, std::size_t n) {
    const Vector3 u{air.flow.cell_velocity(air.grid, 0, c), air.flow.cell_velocity(air.grid, 1, c),
                    air.flow.cell_velocity(air.grid, 2, c)};
    const double here = dot(u, u), p = air.flow.pressure[c];
    square[n] = here > square[n] ? here : square[n];
    least[n] = p < least[n] ? p : least[n];
    most[n] = p > most[n] ? p : most[n];
    excess.add(std::abs(air.excess[c]));
  });
  return {.max_speed = std::sqrt(*std::max_element(square.begin(), square.end())),
          .min_pressure = *std::min_element(least.begin(), least.end()),
          .max_pressure = *std::max_element(most.begin(), most.end()),
          .imbalance = 0.5 * excess.value() * air.grid.volume()};
}

}  // namespace talus::continuum
