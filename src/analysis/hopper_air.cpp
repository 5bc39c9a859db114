// SPDX-License-Identifier: Apache-2.0
#include "analysis/hopper_air.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

// Places of the paper's figures, m; the box is 100 mm wide, the plate 100 mm high.
constexpr double profile_height = 120e-3, profile_left = 20e-3, profile_right = 80e-3;
constexpr double edge_of_slit = 31e-3, column_from = 20e-3, column_to = 190e-3;
constexpr double below_slit = 50e-3;
constexpr double hardly_any = 0.01, in_stream = 0.1;  // packing
constexpr int cells_beside_plug = 5;                  // of a mean

int middle_layer(const GridSnapshot& air) {
  return air.count[1] / 2;
}

/// Sum of the drag over that of the weight, upwards positive.
double drag_over_weight(const GridSnapshot& air, const HopperSetting& s) {
  const auto& drag = air.vectors("drag");
  const auto& fraction = air.scalars("solid_fraction");
  const int k = air.cell_at(2, profile_height);
  double upward = 0, weight = 0;
  for (int j = 0; j < air.count[1]; ++j)
    for (int i = 0; i < air.count[0]; ++i) {
      const double x = air.centre(i, j, k).x;
      if (x < profile_left || x > profile_right) continue;
      const std::size_t c = air.index(i, j, k);
      upward += drag[c].z;
      weight += fraction[c] * s.grain_density * s.gravity;
    }
  return weight > 0 ? upward / weight : HopperFrame::none;
}

/// Height of the largest |dP/dz| in the column at the edge of the slit.
double drop_height(const GridSnapshot& air) {
  const auto& pressure = air.scalars("pressure");
  const int i = air.cell_at(0, edge_of_slit), j = middle_layer(air);
  double steepest = -1, height = HopperFrame::none;
  for (int k = 1; k + 1 < air.count[2]; ++k) {
    const double z = air.centre(i, j, k).z;
    if (z <= column_from || z >= column_to) continue;
    const double step = std::abs(pressure[air.index(i, j, k + 1)] - pressure[air.index(i, j, k - 1)]);
    if (step > steepest) steepest = step, height = z;
  }
  return height;
}

/// Mean pressure beside the stream less that within it.
double outside_less_inside(const GridSnapshot& air) {
  const auto& pressure = air.scalars("pressure");
  const auto& fraction = air.scalars("solid_fraction");
  const int j = middle_layer(air), k = air.cell_at(2, below_slit);
  std::vector<double> outside, inside;
  for (int i = 0; i < air.count[0]; ++i) {
    const std::size_t c = air.index(i, j, k);
    if (fraction[c] < hardly_any) outside.push_back(pressure[c]);
    if (fraction[c] > in_stream) inside.push_back(pressure[c]);
  }
  return outside.empty() || inside.empty() ? HopperFrame::none : mean(outside) - mean(inside);
}

/// Velocities above the slit: in the plug, where grains fall at more than half of their largest speed there, and beside
/// it.
void measure_profile(HopperFrame& frame, const GridSnapshot& air) {
  const auto& velocity = air.vectors("velocity");
  const auto& grains = air.vectors("grain_velocity");
  const int j = middle_layer(air), k = air.cell_at(2, profile_height), n = air.count[0];
  double fastest = 0;
  for (int i = 0; i < n; ++i) fastest = std::max(fastest, -grains[air.index(i, j, k)].z);
  if (!(fastest > 0)) return;
  std::vector<double> within, falling;
  int first = n, last = -1;
  for (int i = 0; i < n; ++i) {
    const std::size_t c = air.index(i, j, k);
    if (!(-grains[c].z > 0.5 * fastest)) continue;
    within.push_back(velocity[c].z);
    falling.push_back(-grains[c].z);
    first = std::min(first, i), last = std::max(last, i);
  }
  frame.air_velocity_within_plug = mean(within);
  frame.air_velocity_slowness = std::abs(mean(within)) / mean(falling);
  double beside = HopperFrame::none;
  for (int from = 0; from + cells_beside_plug <= n; ++from) {
    const int to = from + cells_beside_plug;
    if (to > first && from <= last) continue;
    double sum = 0;
    for (int i = from; i < to; ++i) sum += velocity[air.index(i, j, k)].z;
    beside = std::fmax(beside, sum / cells_beside_plug);
  }
  frame.air_velocity_beside_plug = beside;
}

}  // namespace

double circulation(const GridSnapshot& air, double left, double right, double bottom, double top) {
  const auto& u = air.vectors("velocity");
  const auto& fraction = air.scalars("solid_fraction");
  const int j = middle_layer(air);
  const int i_from = air.cell_at(0, left), k_from = air.cell_at(2, bottom);
  int i_to = i_from, k_to = k_from;  // one beyond the last
  while (i_to < air.count[0] && air.centre(i_to, j, k_from).x < right) ++i_to;
  while (k_to < air.count[2] && air.centre(i_from, j, k_to).z < top) ++k_to;
  double sum = 0;
  for (int k = k_from; k < k_to; ++k)
    for (int i = i_from; i < i_to; ++i) {
      if (!(fraction[air.index(i, j, k)] < hardly_any)) continue;
      const int west = std::max(i - 1, i_from), east = std::min(i + 1, i_to - 1);
      const int below = std::max(k - 1, k_from), above = std::min(k + 1, k_to - 1);
      if (east == west || above == below) continue;
      sum += (u[air.index(i, j, above)].x - u[air.index(i, j, below)].x) / ((above - below) * air.spacing.z) -
             (u[air.index(east, j, k)].z - u[air.index(west, j, k)].z) / ((east - west) * air.spacing.x);
    }
  return sum * air.spacing.x * air.spacing.z;
}

void measure_air(HopperFrame& frame, const GridSnapshot& air, const HopperSetting& setting) {
  const HopperShape& shape = setting.shape;
  if (!shape.plate) return;
  frame.drag_to_weight = drag_over_weight(air, setting);
  frame.air_pressure_drop_height = drop_height(air);
  frame.air_pressure_outside_inside = outside_less_inside(air);
  measure_profile(frame, air);
  const double middle = shape.middle(), plate = shape.plate->height;
  frame.air_circulation_bin_left = circulation(air, 0, middle, 0, plate);
  frame.air_circulation_bin_right = circulation(air, middle, shape.width, 0, plate);
  frame.air_circulation_hopper_left = circulation(air, 0, middle, plate, shape.height);
  frame.air_circulation_hopper_right = circulation(air, middle, shape.width, plate, shape.height);
}

}  // namespace talus
