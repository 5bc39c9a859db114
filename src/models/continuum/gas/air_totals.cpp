// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/gas/air_totals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/exact_sum.hpp"

namespace talus::continuum {

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
  return {.largest_speed = std::sqrt(*std::max_element(square.begin(), square.end())),
          .least_pressure = *std::min_element(least.begin(), least.end()),
          .largest_pressure = *std::max_element(most.begin(), most.end()),
          .imbalance = 0.5 * excess.value() * air.grid.volume()};
}

}  // namespace talus::continuum
