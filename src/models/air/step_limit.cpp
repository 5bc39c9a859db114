// SPDX-License-Identifier: Apache-2.0
/// What holds a step of the air as short as it is: for the message of a run that would not end.
#include <fmt/format.h>

#include <cmath>

#include "models/air/flow.hpp"

namespace talus::air {

namespace {

/// Where in the grid a quantity is largest.
struct Largest {
  double value = 0;
  std::array<int, 3> cell{};

  void meet(double other, int i, int j, int k) {
    if (other > value) value = other, cell = {i, j, k};
  }
};

}  // namespace

NumericalError::Report AirFlow::step_limit(const Solids& solids, const AirState& state) const {
  const Grid& grid = passages_.grid;
  Largest moved, response;  // 1/s: cells in a second, and the rate at which the pressure stops grains that dilate
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::size_t c = grid.index(i, j, k);
        double cells = 0;
        for (int axis = 0; axis < 3; ++axis) {
          const double* u = state.velocity[static_cast<std::size_t>(axis)].data() + c;
          cells += std::max(std::abs(u[0]), std::abs(u[grid.stride(axis)])) / grid.spacing[axis];
        }
        moved.meet(cells, i, j, k);
        const double solid = solids.fraction[c], gap = 1 - solid;
        if (solid > 0) response.meet(drag_[c] / (gap * gap * solid * parameters_.grain_density), i, j, k);
      }
  const bool by_motion = parameters_.courant * response.value < parameters_.response * moved.value;
  const Largest& worst = by_motion ? moved : response;
  const auto [i, j, k] = worst.cell;
  const Vector3 x = grid.centre(i, j, k);
  NumericalError::Report report{};
  report.place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m, solid fraction {:.3g}", i, j, k, x.x,
                             x.y, x.z, solids.fraction[grid.index(i, j, k)]);
  report.term = by_motion ? fmt::format("Courant number of the air, which crosses {:.3g} cells a second", moved.value)
                          : fmt::format("drag on the grains, which stops them at {:.3g} 1/s, Eq. 20", response.value);
  report.advice = by_motion
                      ? "larger air cells, a larger air.courant"
                      : "larger air cells, a stiffer law of the grains; a box in which grains do not pile up there";
  return report;
}

}  // namespace talus::air
