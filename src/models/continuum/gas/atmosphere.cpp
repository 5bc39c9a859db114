// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/gas/atmosphere.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/elementary.hpp"
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

bool is_air_shared(const Grid& grid) {
  // With fewer cells, or planes of them, messages take longer than what they save.
  return grid.cells() >= 16384 && grid.count[2] >= 16;
}

Atmosphere::Atmosphere(const Parameters& p, const Levels& levels, const Boundary& boundary, const Share& share)
    : levels_(levels),
      boundary_(boundary),
      share_(share),
      openings_(boundary.openings()),
      grain_density_(p.grains.density),
      max_solid_fraction_(std::max(random_close_packing, p.bed.packing)),
      medium_(gas_of(p).medium()),
      deposition_(air_grid(p), boundary_.domain(), boundary_.vessel()),
      flow_(air_grid(p), gas_of(p), boundary_.domain().walls(), boundary_.vessel(),
            is_air_shared(air_grid(p)) ? share.ranks() : one_process()),
      exchange_(air_grid(p), flow_.part()),
      per_solid_volume_(air_grid(p).face_field()),
      slip_square_(air_grid(p).cell_field()) {}

void Atmosphere::advance(ThreadTeam& team, double dt, State& s) {
  if (is_due(s)) move_air(team, dt, s);
  --s.air.steps_left;
  s.air.impulse += dt * s.air.force;
}

void Atmosphere::take_grains(ThreadTeam& team, std::span<const double> smoothing_length, State& s) {
  AirAround& a = s.air;
  flow_.let_in(s.gate_time >= 0);
  if (openings_ != boundary_.openings()) {
    openings_ = boundary_.openings();
    flow_.set_walls(boundary_.domain().walls(), boundary_.vessel());
  }
  const auto add_to_excess = [&](double sign) {
    for_each_cell(team, a.grid, flow_.part().own, [&](int, int, int, std::ptrdiff_t c) {
      a.excess[static_cast<std::size_t>(c)] += sign * a.solids.fraction[static_cast<std::size_t>(c)];
    });
  };
  add_to_excess(1);
  find_weights(team, smoothing_length, s);
  deposit(team, s);
  add_up(s.air.solids);
  leave_overfull(s.air.solids);
  add_to_excess(-1);
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
  const air::Part& part = flow_.part();
  const auto size = [&](std::ptrdiff_t c) { return std::abs(pressure[c]); };
  a.swing_max = std::max(a.swing_max, largest_of(part.ranks, max_of_cells(team, a.grid, part.own_slab(), size)));
  watch.reset();
  bring(std::array{&per_solid_volume_[0], &per_solid_volume_[1], &per_solid_volume_[2]});
  received_.resize(s.position.size());
  deposition_.distribute(team, s.mass / grain_density_, s.ratios(), per_solid_volume_, received_);
  for_each(team, received_.size(),
           [&](std::size_t i) { a.acceleration[i] = (1 / (s.mass_of(i) * duration)) * received_[i]; });
  const FixedPoint point(s.impulse_unit / duration);
  FixedVector force = accumulate(
      team, received_.size(), FixedVector{},
      [&](std::size_t i, FixedVector& sum) { sum.add(point, s.mass_of(i) * a.acceleration[i]); },
      [](FixedVector one, const FixedVector& other) { return one += other; });
  sum_up(share_.ranks(), std::span(&force, 1));
  a.force = force.value(point);
  ++a.steps;
  a.iterations = static_cast<std::uint64_t>(flow_.iterations());
  measure_slip(team, s);
}

/// Where particles of two sizes meet, kernels of their own widths put 1.16 times the solid volume on the finer side and
/// 0.84 times on the other. So with levels the width grows with the distance, by at most a few per cent a spacing.
void Atmosphere::find_weights(ThreadTeam& team, std::span<const double> smoothing_length, const State& s) {
  if (levels_.count() > 0) {
    deposited_length_.resize(s.position.size());
    for_each(team, s.position.size(), [&](std::size_t i) {
      const double own = cube_root(size_ratio(s.ratios()[i]));
      deposited_length_[i] = smoothing_length[i] * std::max(1.0, levels_.smooth_spacing(s.position[i]) / own);
    });
    smoothing_length = deposited_length_;
  }
  deposition_.find_weights(team, s.position, smoothing_length, share_.part().is_copy);
}

/// What the particles of this process put on the cells.
void Atmosphere::deposit(ThreadTeam& team, State& s) const {
  deposition_.deposit(team, s.mass / grain_density_, s.ratios(), s.velocity, s.air.solids.fraction, s.air.solids.flux);
}

/// The deposits of all processes, where this one needs them.
void Atmosphere::add_up(air::Solids& solids) {
  if (flow_.part().ranks.is_alone()) return add_up_all(solids);
  const Stopwatch watch(share_.time().messages);
  exchange_.find_rows(deposition_);
  exchange_.add_up(solids);
}

/// The same on all cells.
void Atmosphere::add_up_all(air::Solids& solids) const {
  share_.ranks().add_up(solids.fraction);
  for (CellField& component : solids.flux) share_.ranks().add_up(component);
}

/// Fields of cells to the rows of the particles.
void Atmosphere::bring(std::span<CellField* const> fields) {
  const Stopwatch watch(share_.time().messages);
  exchange_.bring(fields);
}

/// A cell whose centre is within the vessel has the grains of the cells next to it that the wall cuts, too. What is
/// more than grains can fill stands beyond the wall: the air meets the rest, as fast, and what it exchanges with that
/// goes to all of them.
void Atmosphere::leave_overfull(air::Solids& solids) {
  overfull_.clear();
  if (boundary_.vessel().is_empty()) return;
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
  find_weights(team, smoothing_length, s);
  deposit(team, s);
  add_up_all(s.air.solids);
  leave_overfull(s.air.solids);
  flow_.let_in(s.gate_time >= 0);
  flow_.begin(team, s.air.solids, s.air.flow);
}

/// The slip of each particle is the mean of its cells'.
void Atmosphere::measure_slip(ThreadTeam& team, State& s) {
  const AirAround& a = s.air;
  for_each_row(team, a.grid, a.grid.count, flow_.part().own, [&](int, int, std::ptrdiff_t begin, std::ptrdiff_t end) {
    auto& [x, y, z] = per_solid_volume_;
    air::find_slip_of_row(end - begin, flow_.cells_from(begin, a.solids, a.flow.velocity), x.data() + begin,
                          y.data() + begin, z.data() + begin, slip_square_.data() + begin);
  });
  bring(std::array{&per_solid_volume_[0], &per_solid_volume_[1], &per_solid_volume_[2], &slip_square_});
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

AirTotals Atmosphere::totals(const AirAround& air) const {
  InTurn<double> square{}, least, most;
  ExactSum excess;
  least.fill(infinity), most.fill(-infinity);
  for_each_air_cell(air.grid, flow_.part().own_slab(), [&](std::size_t c, std::size_t n) {
    const Vector3 u{air.flow.cell_velocity(air.grid, 0, c), air.flow.cell_velocity(air.grid, 1, c),
                    air.flow.cell_velocity(air.grid, 2, c)};
    const double here = dot(u, u), p = air.flow.pressure[c];
    square[n] = here > square[n] ? here : square[n];
    least[n] = p < least[n] ? p : least[n];
    most[n] = p > most[n] ? p : most[n];
    excess.add(std::abs(air.excess[c]));
  });
  Votes votes{.least = {*std::min_element(least.begin(), least.end())},
              .largest = {*std::max_element(square.begin(), square.end()), *std::max_element(most.begin(), most.end())},
              .sum = {}};
  const Ranks& ranks = flow_.part().ranks;
  ranks.join(votes);
  ExactSum total;
  for (const ExactSum& part : ranks.gather_values(std::vector{excess})) total.add(part);
  return {.max_speed = std::sqrt(votes.largest[0]),
          .min_pressure = votes.least[0],
          .max_pressure = votes.largest[1],
          .imbalance = 0.5 * total.value() * air.grid.volume()};
}

void Atmosphere::gather(AirAround& air) const {
  std::vector<CellField*> fields{&air.flow.pressure, &air.flow.pressure_before, &air.solids.fraction, &air.excess};
  for (FaceField* const field :
       {&air.flow.velocity, &air.flow.momentum, &air.flow.momentum_before, &air.flow.drag, &air.solids.flux})
    for (CellField& component : *field) fields.push_back(&component);
  flow_.part().gather(fields);
}

}  // namespace talus::continuum
