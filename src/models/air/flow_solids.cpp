// SPDX-License-Identifier: Apache-2.0
/// What the air takes from the grains in its cells: void fraction, velocity, drag, and how long a step they allow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "models/air/flow.hpp"
#include "numerics/grid/loops.hpp"

namespace talus::air {

/// Void fraction, solid fraction and grains' velocity on the faces: means of the two cells, of the one within at an
/// end.
void AirFlow::take_solids(ThreadTeam& team, const Solids& solids) {
  const Grid& grid = passages_.grid;
  const double* fraction = solids.fraction.data();
  for_each_cell(team, grid, [&](int i, int j, int k, std::ptrdiff_t c) {
    const double s = fraction[c];
    if (s >= 0 && s < 1) return;
    const Vector3 x = grid.centre(i, j, k);
    throw NumericalError(
        {.what = fmt::format("the solid fraction is {:.4g}", s),
         .term = "void fraction of Eq. 18",
         .place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m", i, j, k, x.x, x.y, x.z),
         .advice = "a stiffer law of the grains, or air cells no smaller than the grains' spacing"});
  });
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double* flux = solids.flux[a].data();
    double *solid = solid_fraction_[a].data(), *gap = void_fraction_[a].data(), *velocity = grain_velocity_[a].data();
    for_each_run(team, passages_, axis, [&](const FaceRun& run) {
      for (auto f = run.begin; f < run.end; ++f) {
        const double s = 0.5 * (fraction[f + run.before] + fraction[f + run.here]);
        const double through = 0.5 * (flux[f + run.before] + flux[f + run.here]);
        solid[f] = s, gap[f] = 1 - s;
        velocity[f] = s > 0 ? through / s : 0;
      }
    });
  }
}

/// beta of the cells, at the slip in their centres.
void AirFlow::measure_drag(ThreadTeam& team, const Solids& solids, const FaceField& velocity) {
  const Grid& grid = passages_.grid;
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
    const Grid& grid = flow.passages_.grid;
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
  const Grid& grid = passages_.grid;
  measure_drag(team, solids, state.velocity);
  const Rates rates{*this, solids, state};
  const double crossing = largest_of_cells(team, grid, [&](std::ptrdiff_t c) { return rates.crossing(c); });
  const double response = largest_of_cells(team, grid, [&](std::ptrdiff_t c) { return rates.response(c); });
  double dt = parameters_.longest_step;
  if (crossing > 0) dt = std::min(dt, parameters_.courant / crossing);
  if (response > 0) dt = std::min(dt, parameters_.response / response);
  return dt;
}

StepLimit AirFlow::explain_time_step(ThreadTeam& team, const Solids& solids, const AirState& state) {
  const Grid& grid = passages_.grid;
  StepLimit limit{.step = time_step(team, solids, state), .term = "air.longest_step", .place = "all cells"};
  const Rates rates{*this, solids, state};
  bool found = limit.step >= parameters_.longest_step;
  ThreadTeam alone(1);
  for_each_cell(alone, grid, [&](int i, int j, int k, std::ptrdiff_t c) {
    const double crossing = rates.crossing(c), response = rates.response(c);
    const bool drags = response > 0 && parameters_.response / response <= limit.step;
    if (found || (!drags && !(crossing > 0 && parameters_.courant / crossing <= limit.step))) return;
    found = true;
    const auto n = static_cast<std::size_t>(c);
    const Vector3 x = grid.centre(i, j, k);
    limit.place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m", i, j, k, x.x, x.y, x.z);
    limit.term = drags ? fmt::format("drag, Eq. 20: {:.3g} kg/(m3 s) at a solid fraction of {:.4g}", drag_[n],
                                     solids.fraction[n])
                       : fmt::format("convection, Eq. 18: the air crosses the cell in {:.3g} s", 1 / crossing);
  });
  return limit;
}

}  // namespace talus::air
