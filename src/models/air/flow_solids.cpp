// SPDX-License-Identifier: Apache-2.0
/// What the air takes from the grains in its cells: void fraction, velocity, drag, and how long a step they allow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "models/air/flow.hpp"
#include "models/air/flow_rows.hpp"
#include "numerics/grid/loops.hpp"

namespace talus::air {

void AirFlow::check_fractions(ThreadTeam& team, Slices rows, const CellField& fractions) const {
  const Grid& grid = apertures_.grid;
  const double* fraction = fractions.data();
  for_each_row(team, grid, grid.count, rows, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
    if (are_fractions(end - begin, fraction + begin)) return;
    const double* wrong = std::find_if(fraction + begin, fraction + end, [](double s) { return !(s >= 0 && s < 1); });
    const int i = static_cast<int>(wrong - (fraction + begin));
    const Vector3 x = grid.centre(i, j, k);
    throw NumericalError(
        {.what = fmt::format("the solid fraction is {:.4g}", *wrong),
         .term = "void fraction of Eq. 18",
         .place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m", i, j, k, x.x, x.y, x.z),
         .advice = "a stiffer law of the grains, or air cells no smaller than the grains' spacing"});
  });
}

/// Void fraction, solid fraction and grains' velocity on a row of faces: means of the two cells, of the one within at
/// an end.
void AirFlow::find_solids(const Solids& solids, int axis, int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
  const auto a = static_cast<std::size_t>(axis);
  const double *fraction = solids.fraction.data(), *flux = solids.flux[a].data();
  for_each_run_of_row(apertures_, axis, j, k, begin, end, [&](const FaceRun& run) {
    const auto f = run.begin;
    find_solids_of_row(run.end - f,
                       {.fraction_before = fraction + f + run.before,
                        .fraction_here = fraction + f + run.here,
                        .flux_before = flux + f + run.before,
                        .flux_here = flux + f + run.here},
                       solid_fraction_[a].data() + f, void_fraction_[a].data() + f, grain_velocity_[a].data() + f);
  });
}

void AirFlow::set_solids(ThreadTeam& team, const Solids& solids) {
  check_fractions(team, part_.all, solids.fraction);
  for (int axis = 0; axis < 3; ++axis) {
    for_each_row(
        team, apertures_.grid, apertures_.faces(axis), part_.all,
        [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) { find_solids(solids, axis, j, k, begin, end); });
    for (FaceField* field : {&solid_fraction_, &void_fraction_, &grain_velocity_})
      apertures_.wrap((*field)[static_cast<std::size_t>(axis)]);
  }
}

CellRow AirFlow::cells_from(std::ptrdiff_t begin, const Solids& solids, const FaceField& velocity) const {
  CellRow row{.fraction = solids.fraction.data() + begin, .flux = {}, .velocity = {}, .next = {}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    row.flux[axis] = solids.flux[a].data() + begin, row.velocity[axis] = velocity[a].data() + begin;
    row.next[axis] = apertures_.grid.stride(axis);
  }
  return row;
}

void AirFlow::measure_drag_of_row(std::ptrdiff_t begin, const CellRow& row) {
  double* const drag = drag_.data() + begin;
  find_drag_of_row(apertures_.grid.count[0], parameters_.drag, medium_, row, drag);
  if (grains_share() == 0 && coupling::is_of_pressure_drops(parameters_.drag))
    for (std::ptrdiff_t c = 0; c < apertures_.grid.count[0]; ++c)
      drag[c] = coupling::drag_alone(drag[c], 1 - row.fraction[c]);
}

/// What bounds the step in `count` cells, at the drag that has been measured.
Rates AirFlow::rates(std::ptrdiff_t begin, std::ptrdiff_t count, const CellRow& row) const {
  const Vector3& width = apertures_.grid.spacing;
  return max_rates_of_row(count, {1 / width.x, 1 / width.y, 1 / width.z}, parameters_.grain_density, row,
                          drag_.data() + begin);
}

double AirFlow::time_step(ThreadTeam& team, const Solids& solids, const AirState& state) {
  const Grid& grid = apertures_.grid;
  max_of_row_.resize(static_cast<std::size_t>(grid.count[1]) * static_cast<std::size_t>(grid.count[2]));
  for_each_row(team, grid, grid.count, part_.own, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
    const CellRow row = cells_from(begin, solids, state.velocity);
    measure_drag_of_row(begin, row);
    max_of_row_[static_cast<std::size_t>(k * grid.count[1] + j)] = rates(begin, end - begin, row);
  });
  Rates most{0, 0};
  for (std::size_t row = part_.own_slab().begin; row < part_.own_slab().end; ++row)
    most = larger(most, max_of_row_[row]);
  Votes votes{.least = {}, .largest = {most.crossing, most.response}, .sum = {}};
  part_.ranks.join(votes);
  most = {votes.largest[0], votes.largest[1]};
  double dt = parameters_.max_step;
  if (most.crossing > 0) dt = std::min(dt, parameters_.courant / most.crossing);
  if (most.response > 0) dt = std::min(dt, parameters_.response / most.response);
  return dt;
}

NumericalError::Report AirFlow::step_limit(const Solids& solids, const AirState& state) const {
  const Grid& grid = apertures_.grid;
  double crossing = 0, response = 0;
  std::array<int, 3> crossed{}, held{};
  for (std::size_t row = part_.own_slab().begin; row < part_.own_slab().end; ++row) {
    const int j = static_cast<int>(row) % grid.count[1], k = static_cast<int>(row) / grid.count[1];
    for (int i = 0; i < grid.count[0]; ++i) {
      const auto c = static_cast<std::ptrdiff_t>(grid.index(i, j, k));
      const Rates here = rates(c, 1, cells_from(c, solids, state.velocity));
      if (here.crossing > crossing) crossing = here.crossing, crossed = {i, j, k};
      if (here.response > response) response = here.response, held = {i, j, k};
    }
  }
  Votes votes{.least = {}, .largest = {crossing, response}, .sum = {}};
  part_.ranks.join(votes);
  const bool by_motion = parameters_.courant * votes.largest[1] < parameters_.response * votes.largest[0];
  const bool is_here = by_motion ? !(crossing < votes.largest[0]) : !(response < votes.largest[1]);
  Votes first{
      .least = {is_here ? part_.ranks.rank() : std::numeric_limits<double>::infinity()}, .largest = {}, .sum = {}};
  part_.ranks.join(first);
  const auto [i, j, k] = by_motion ? crossed : held;
  const Vector3 x = grid.centre(i, j, k);
  NumericalError::Report report{};
  report.place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m, solid fraction {:.3g}", i, j, k, x.x,
                             x.y, x.z, solids.fraction[grid.index(i, j, k)]);
  report.term = by_motion ? fmt::format("Courant number of the air, which crosses {:.3g} cells a second", crossing)
                          : fmt::format("drag on the grains, which stops them at {:.3g} 1/s, Eq. 20", response);
  if (!by_motion)
    report.advice = "larger air cells, a stiffer law of the grains; a box in which grains do not pile up there";
  else if (parameters_.courant < max_courant)
    report.advice = fmt::format("larger air cells, a larger air.courant (up to {:g})", max_courant);
  else
    report.advice = "larger air cells; a slower inflow or a smaller difference of pressure";
  return report_of_one(part_.ranks,
                       first.least[0] < part_.ranks.rank() || !is_here ? NumericalError::Report{} : report);
}

}  // namespace talus::air
