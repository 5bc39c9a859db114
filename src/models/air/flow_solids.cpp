// SPDX-License-Identifier: Apache-2.0
/// What the air takes from the grains in its cells: void fraction, velocity, drag, and how long a step they allow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "models/air/flow.hpp"
#include "models/air/flow_rows.hpp"
#include "numerics/grid/loops.hpp"

namespace talus::air {

/// Void fraction, solid fraction and grains' velocity on the faces: means of the two cells, of the one within at an
/// end.
void AirFlow::set_solids(ThreadTeam& team, const Solids& solids) {
  const Grid& grid = apertures_.grid;
  const double* fraction = solids.fraction.data();
  for_each_row(team, grid, grid.count, [&](int j, int k, std::ptrdiff_t begin, std::ptrdiff_t end) {
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
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double* flux = solids.flux[a].data();
    for_each_run(team, apertures_, axis, [&](const FaceRun& run) {
      const auto f = run.begin;
      find_solids_of_row(run.end - f,
                         {.fraction_before = fraction + f + run.before,
                          .fraction_here = fraction + f + run.here,
                          .flux_before = flux + f + run.before,
                          .flux_here = flux + f + run.here},
                         solid_fraction_[a].data() + f, void_fraction_[a].data() + f, grain_velocity_[a].data() + f);
    });
    for (FaceField* field : {&solid_fraction_, &void_fraction_, &grain_velocity_}) apertures_.wrap((*field)[a]);
  }
}

/// beta of the cells, at the slip in their centres.
void AirFlow::measure_drag(ThreadTeam& team, const Solids& solids, const FaceField& velocity) {
  const Grid& grid = apertures_.grid;
  const coupling::DragMedium medium = parameters_.medium();
  for_each_cell(team, grid, [&](int, int, int, std::ptrdiff_t place) {
    const auto c = static_cast<std::size_t>(place);
    const double s = solids.fraction[c];
    if (s <= 0) {
      drag_[c] = 0;
      return;
    }
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double u = 0.5 * (velocity[a][c] + velocity[a][c + static_cast<std::size_t>(grid.stride(axis))]);
      const double slip = u - solids.flux[a][c] / s;
      square += slip * slip;
    }
    drag_[c] = coupling::drag_coefficient(parameters_.drag, medium, s, std::sqrt(square));
  });
}

/// What bounds the step in a cell, 1/s.
struct AirFlow::Rates {
  const AirFlow& flow;
  const Solids& solids;
  const AirState& state;

  /// At which the air crosses it.
  double crossing(std::ptrdiff_t c) const {
    const Grid& grid = flow.apertures_.grid;
    const auto fastest = [&](int axis) {
      const double* u = state.velocity[static_cast<std::size_t>(axis)].data();
      return std::max(std::abs(u[c]), std::abs(u[c + grid.stride(axis)])) / grid.spacing[axis];
    };
    return fastest(0) + fastest(1) + fastest(2);
  }
  /// A bed that dilates draws air through its pores; the pressure that this takes stops it at the rate
  /// beta/(Phi^2 rho_b), whatever the wave length.
  double response(std::ptrdiff_t c) const {
    const double fraction = solids.fraction[static_cast<std::size_t>(c)], phi = 1 - fraction;
    return fraction > 0
               ? flow.drag_[static_cast<std::size_t>(c)] / (phi * phi * fraction * flow.parameters_.grain_density)
               : 0;
  }
};

double AirFlow::time_step(ThreadTeam& team, const Solids& solids, const AirState& state) {
  const Grid& grid = apertures_.grid;
  measure_drag(team, solids, state.velocity);
  const Rates rates{*this, solids, state};
  const double crossing = largest_of_cells(team, grid, [&](std::ptrdiff_t c) { return rates.crossing(c); });
  const double response = largest_of_cells(team, grid, [&](std::ptrdiff_t c) { return rates.response(c); });
  double dt = parameters_.longest_step;
  if (crossing > 0) dt = std::min(dt, parameters_.courant / crossing);
  if (response > 0) dt = std::min(dt, parameters_.response / response);
  return dt;
}

NumericalError::Report AirFlow::step_limit(const Solids& solids, const AirState& state) const {
  const Grid& grid = apertures_.grid;
  const Rates rates{*this, solids, state};
  double crossing = 0, response = 0;
  std::array<int, 3> crossed{}, held{};
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) {
        const auto c = static_cast<std::ptrdiff_t>(grid.index(i, j, k));
        if (rates.crossing(c) > crossing) crossing = rates.crossing(c), crossed = {i, j, k};
        if (rates.response(c) > response) response = rates.response(c), held = {i, j, k};
      }
  const bool by_motion = parameters_.courant * response < parameters_.response * crossing;
  const auto [i, j, k] = by_motion ? crossed : held;
  const Vector3 x = grid.centre(i, j, k);
  NumericalError::Report report{};
  report.place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m, solid fraction {:.3g}", i, j, k, x.x,
                             x.y, x.z, solids.fraction[grid.index(i, j, k)]);
  report.term = by_motion ? fmt::format("Courant number of the air, which crosses {:.3g} cells a second", crossing)
                          : fmt::format("drag on the grains, which stops them at {:.3g} 1/s, Eq. 20", response);
  report.advice = by_motion
                      ? "larger air cells, a larger air.courant"
                      : "larger air cells, a stiffer law of the grains; a box in which grains do not pile up there";
  return report;
}

}  // namespace talus::air
