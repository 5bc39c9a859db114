// SPDX-License-Identifier: Apache-2.0
#include "analysis/cell_means.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/granular_state.hpp"

namespace talus {

namespace {

constexpr const char* stress_names[6] = {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};

struct Column {
  const char *name, *unit;
};
constexpr Column columns[] = {{"packing", "1"}, {"pressure", "Pa"}, {"shear_stress", "Pa"}, {"inertial_number", "1"}};

/// Sums over the particles of a cell in one snapshot.
struct Cell {
  double count = 0, packing = 0, shear_rate = 0;
  Vector3 velocity;
  std::array<double, 6> stress{};
};

double deviation(double squares, double mean, double count) {
  return count > 1 ? std::sqrt(std::max(0.0, (squares - count * mean * mean) / (count - 1))) : 0;
}

}  // namespace

CellBox cells_over(const Vector3& low, const Vector3& high, double cell) {
  CellBox box{.low = low, .cell = cell};
  for (int axis = 0; axis < 3; ++axis)
    box.count[static_cast<std::size_t>(axis)] =
        std::max(1, static_cast<int>(std::ceil((high[axis] - low[axis]) / cell - 1e-9)));
  return box;
}

CellMeans::CellMeans(const CellBox& box, double diameter, double grain_density)
    : box_(box),
      diameter_(diameter),
      grain_density_(grain_density),
      sums_(static_cast<std::size_t>(box.count[0]) * static_cast<std::size_t>(box.count[1]) *
            static_cast<std::size_t>(box.count[2])) {}

void CellMeans::take(const Snapshot& snapshot) {
  ++taken_;
  const auto position = snapshot.positions(), velocity = snapshot.vectors("velocity");
  const auto packing = snapshot.scalars("packing"), shear_rate = snapshot.scalars("shear_rate");
  std::array<std::span<const double>, 6> stress;
  for (std::size_t c = 0; c < 6; ++c) stress[c] = snapshot.scalars(stress_names[c]);
  std::vector<Cell> cells(sums_.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    std::array<double, 3> index{};
    bool inside = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const int axis = static_cast<int>(a);
      index[a] = std::floor((position[i][axis] - box_.low[axis]) / box_.cell);
      inside = inside && index[a] >= 0 && index[a] < box_.count[a];
    }
    if (!inside) continue;
    const auto [x, y, z] = index;
    Cell& cell = cells[static_cast<std::size_t>(x + box_.count[0] * (y + box_.count[1] * z))];
    ++cell.count;
    cell.velocity += velocity[i];
    cell.packing += packing[i];
    cell.shear_rate += shear_rate[i];
    for (std::size_t c = 0; c < 6; ++c) cell.stress[c] += stress[c][i];
  }
  for (std::size_t n = 0; n < cells.size(); ++n) {
    const Cell& cell = cells[n];
    if (cell.count == 0) continue;
    const double share = 1 / cell.count;
    const auto s = [&](std::size_t c) { return share * cell.stress[c]; };
    const double pressure = (s(0) + s(1) + s(2)) / 3;
    const double diagonal = std::pow(s(0) - pressure, 2) + std::pow(s(1) - pressure, 2) + std::pow(s(2) - pressure, 2);
    const double shear = std::sqrt(0.5 * diagonal + s(3) * s(3) + s(4) * s(4) + s(5) * s(5));
    const double inertial =
        pressure > 0 ? inertial_number(share * cell.shear_rate, pressure, diameter_, grain_density_) : 0;
    const std::array<double, numbers> values{share * cell.packing, pressure, shear, inertial};
    const Vector3 u = share * cell.velocity;
    Sum& sum = sums_[n];
    ++sum.count;
    sum.velocity += u;
    sum.velocity_squared += dot(u, u);
    for (std::size_t k = 0; k < numbers; ++k) sum.value[k] += values[k], sum.squared[k] += values[k] * values[k];
  }
}

GridSnapshot CellMeans::result(double time) const {
  GridSnapshot grid{.time = time,
                    .step = 0,
                    .count = box_.count,
                    .low = box_.low,
                    .spacing = {box_.cell, box_.cell, box_.cell},
                    .columns = {}};
  std::vector<Vector3> velocity;
  std::vector<double> swing, filled;
  for (const Sum& sum : sums_) {
    const double count = std::max(1.0, sum.count);
    velocity.push_back((1 / count) * sum.velocity);
    swing.push_back(deviation(sum.velocity_squared, norm(velocity.back()), sum.count));
    filled.push_back(taken_ > 0 ? sum.count / taken_ : 0);
  }
  grid.columns.push_back({"velocity", "m/s", velocity});
  grid.columns.push_back({"velocity_deviation", "m/s", swing});
  for (std::size_t k = 0; k < numbers; ++k) {
    std::vector<double> means, deviations;
    for (const Sum& sum : sums_) {
      means.push_back(sum.value[k] / std::max(1.0, sum.count));
      deviations.push_back(deviation(sum.squared[k], means.back(), sum.count));
    }
    grid.columns.push_back({columns[k].name, columns[k].unit, means});
    grid.columns.push_back({std::string(columns[k].name) + "_deviation", columns[k].unit, deviations});
  }
  grid.columns.push_back({"filled", "1", filled});
  return grid;
}

}  // namespace talus
