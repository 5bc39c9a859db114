// SPDX-License-Identifier: Apache-2.0
/// The air between the grains and around them, as evaluated by Yuu & Umekage (2011), sections 5.1 and 5.2.
#include <algorithm>
#include <cmath>

#include "analysis/hopper_numbers.hpp"
#include "analysis/statistics.hpp"

namespace talus::hopper {

namespace {

constexpr double none = HopperRun::none;
constexpr double hardly_any = 0.01;   // packing
constexpr int cells_beside_plug = 5;  // of a mean

/// Null where there is no air, or no outlet that it passes.
const GridSnapshot* air_of(const HopperSnapshot& s) {
  return s.air && s.shape().plate ? s.air() : nullptr;
}

int middle_layer(const GridSnapshot& air) {
  return air.count[1] / 2;
}

/// The plug at a height: the cells where grains fall at more than half of their largest speed there, first to last.
struct Plug {
  std::vector<double> air, falling;  ///< velocity of the air along z; of the grains downwards, m/s
  int first = 0, last = -1;
};
Plug plug_of(const GridSnapshot& air, int k) {
  const auto& velocity = air.vectors("velocity");
  const auto& grains = air.vectors("grain_velocity");
  const int j = middle_layer(air), n = air.count[0];
  double fastest = 0;
  for (int i = 0; i < n; ++i) fastest = std::max(fastest, -grains[air.index(i, j, k)].z);
  Plug plug{.air = {}, .falling = {}, .first = n, .last = -1};
  for (int i = 0; i < n && fastest > 0; ++i) {
    const std::size_t c = air.index(i, j, k);
    if (!(-grains[c].z > 0.5 * fastest)) continue;
    plug.air.push_back(velocity[c].z);
    plug.falling.push_back(-grains[c].z);
    plug.first = std::min(plug.first, i), plug.last = std::max(plug.last, i);
  }
  return plug;
}

/// The largest |dP/dz| in the column at x.
struct SteepestPressure {
  double height = none, gradient = none;  ///< z, m; dP/dz, Pa/m
};
SteepestPressure steepest_pressure(const HopperSnapshot& s, const Place& place) {
  const GridSnapshot* air = air_of(s);
  SteepestPressure steepest;
  if (!air) return steepest;
  const auto& pressure = air->scalars("pressure");
  const int i = air->cell_at(0, length_of(place, "x")), j = middle_layer(*air);
  for (int k = 1; k + 1 < air->count[2]; ++k) {
    const double z = air->centre(i, j, k).z;
    if (z <= length_of(place, "from") || z >= length_of(place, "to")) continue;
    const double gradient =
        (pressure[air->index(i, j, k + 1)] - pressure[air->index(i, j, k - 1)]) / (2 * air->spacing.z);
    if (std::isnan(steepest.gradient) || std::abs(gradient) > std::abs(steepest.gradient)) steepest = {z, gradient};
  }
  return steepest;
}

}  // namespace

/// Sum of the drag over that of the weight, upwards positive.
double drag_to_weight(const HopperSnapshot& s, const Place& place) {
  const GridSnapshot* air = air_of(s);
  if (!air) return none;
  const auto& drag = air->vectors("drag");
  const auto& fraction = air->scalars("solid_fraction");
  const int k = air->cell_at(2, length_of(place, "height"));
  double upward = 0, weight = 0;
  for (int j = 0; j < air->count[1]; ++j)
    for (int i = 0; i < air->count[0]; ++i) {
      const double x = air->centre(i, j, k).x;
      if (x < length_of(place, "left") || x > length_of(place, "right")) continue;
      const std::size_t c = air->index(i, j, k);
      upward += drag[c].z;
      weight += fraction[c] * s.setting.grain_density * s.setting.gravity;
    }
  return weight > 0 ? upward / weight : none;
}

double air_pressure_drop_height(const HopperSnapshot& s, const Place& place) {
  return steepest_pressure(s, place).height;
}

double air_pressure_gradient_at_drop(const HopperSnapshot& s, const Place& place) {
  return steepest_pressure(s, place).gradient;
}

/// Mean pressure beside the stream less that within it.
double air_pressure_outside_inside(const HopperSnapshot& s, const Place& place) {
  const GridSnapshot* air = air_of(s);
  if (!air) return none;
  const auto& pressure = air->scalars("pressure");
  const auto& fraction = air->scalars("solid_fraction");
  const int j = middle_layer(*air), k = air->cell_at(2, length_of(place, "height"));
  std::vector<double> outside, inside;
  for (int i = 0; i < air->count[0]; ++i) {
    const std::size_t c = air->index(i, j, k);
    if (fraction[c] < hardly_any) outside.push_back(pressure[c]);
    if (fraction[c] > in_stream) inside.push_back(pressure[c]);
  }
  return mean(outside) - mean(inside);
}

double air_velocity_within_plug(const HopperSnapshot& s, const Place& place) {
  const GridSnapshot* air = air_of(s);
  return air ? mean(plug_of(*air, air->cell_at(2, length_of(place, "height"))).air) : none;
}

double air_velocity_slowness(const HopperSnapshot& s, const Place& place) {
  const GridSnapshot* air = air_of(s);
  if (!air) return none;
  const Plug plug = plug_of(*air, air->cell_at(2, length_of(place, "height")));
  return std::abs(mean(plug.air)) / mean(plug.falling);
}

double air_velocity_beside_plug(const HopperSnapshot& s, const Place& place) {
  const GridSnapshot* air = air_of(s);
  if (!air) return none;
  const auto& velocity = air->vectors("velocity");
  const int j = middle_layer(*air), k = air->cell_at(2, length_of(place, "height"));
  const Plug plug = plug_of(*air, k);
  double beside = none;
  for (int from = 0; !plug.air.empty() && from + cells_beside_plug <= air->count[0]; ++from) {
    const int to = from + cells_beside_plug;
    if (to > plug.first && from <= plug.last) continue;
    double sum = 0;
    for (int i = from; i < to; ++i) sum += velocity[air->index(i, j, k)].z;
    beside = std::fmax(beside, sum / cells_beside_plug);
  }
  return beside;
}

double circulation_in(const HopperSnapshot& s, Where where, Half half, Cells cells) {
  const GridSnapshot* air = air_of(s);
  if (!air) return none;
  const double middle = s.shape().middle();
  const Vessel vessel = where == Where::bin ? s.shape().bin() : s.shape().hopper();
  return circulation(*air, half == Half::left ? 0 : middle, half == Half::left ? middle : s.shape().width,
                     vessel.bottom, vessel.top, cells);
}

double circulation(const GridSnapshot& air, double left, double right, double bottom, double top, Cells cells) {
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
      const double grains = fraction[air.index(i, j, k)];
      if (!(cells == Cells::open ? grains < hardly_any : grains > in_stream)) continue;
      const int west = std::max(i - 1, i_from), east = std::min(i + 1, i_to - 1);
      const int below = std::max(k - 1, k_from), above = std::min(k + 1, k_to - 1);
      if (east == west || above == below) continue;
      sum += (u[air.index(i, j, above)].x - u[air.index(i, j, below)].x) / ((above - below) * air.spacing.z) -
             (u[air.index(east, j, k)].z - u[air.index(west, j, k)].z) / ((east - west) * air.spacing.x);
    }
  return sum * air.spacing.x * air.spacing.z;
}

}  // namespace talus::hopper
