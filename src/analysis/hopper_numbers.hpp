// SPDX-License-Identifier: Apache-2.0
/// Numbers of one snapshot of grains in a vessel, the material of the measures; nan where they have no meaning. SI,
/// angles in degrees. Estimators: validation/yuu2011/reference.toml. Those that take lengths from the place name them.
#pragma once

#include <numbers>

#include "analysis/heap_slopes.hpp"
#include "analysis/hopper.hpp"

namespace talus::hopper {

inline constexpr double in_stream = 0.1;  ///< packing of the cells that a stream passes, above

enum class Where { bin, hopper };                                     ///< below the outlet, and above it
const FreeSurface& surface_in(const HopperSnapshot& s, Where where);  ///< empty if there is no hopper
ReposeAngle repose_in(const HopperSnapshot& s, Where where);
double corner_packing_in(const HopperSnapshot& s, Where where, double size);
double corner_packing_over_middle_bin(const HopperSnapshot& s, const Place& place);  ///< size

template <Where where>
double surface_angle_in(const HopperSnapshot& s, const Place&) {
  return surface_angle(surface_in(s, where), s.shape().middle()) / (std::numbers::pi / 180);
}
template <Where where>
double surface_height_in(const HopperSnapshot& s, const Place& place) {  ///< from, to: away from the middle
  return height_beside(surface_in(s, where), s.shape().middle(), length_of(place, "from"), length_of(place, "to"));
}
template <Where where>
double surface_outward_angle_in(const HopperSnapshot& s, const Place& place) {  ///< from, to: away from the middle
  return outward_angle(surface_in(s, where), s.shape().middle(), length_of(place, "from"), length_of(place, "to")) /
         (std::numbers::pi / 180);
}
template <Where where, double ReposeAngle::*angle>
double repose_angle_in(const HopperSnapshot& s, const Place&) {
  return repose_in(s, where).*angle / (std::numbers::pi / 180);
}
template <Where where>
double corner_packing_ratio_in(const HopperSnapshot& s, const Place& place) {
  return corner_packing_in(s, where, length_of(place, "size"));
}
template <double GradientSizes::*size>
double gradient(const HopperSnapshot& s, const Place&) {
  return s.gradient_sizes().*size;
}
template <double GradientSizes::*size>
double cell_gradient(const HopperSnapshot& s, const Place&) {
  return s.cell_gradient_sizes().*size;
}

double mass(const HopperSnapshot& s, const Place& place);                         ///< of all particles
double surface_swelling(const HopperSnapshot& s, const Place& place);             ///< beside, width
double swelling_above_flanks(const HopperSnapshot& s, const Place& place);        ///< from, to, width
double surface_inward_angle_hopper(const HopperSnapshot& s, const Place& place);  ///< from, to
double quiescent_speed(const HopperSnapshot& s, const Place& place);
double packing_max(const HopperSnapshot& s, const Place& place);
double packing_max_outside_impact(const HopperSnapshot& s, const Place& place);  ///< distance
double density_drift(const HopperSnapshot& s, const Place& place);
double stress_ratio(const HopperSnapshot& s, const Place& place);
double stress_ratio_where_dense(const HopperSnapshot& s, const Place& place);
double inertial_share(const HopperSnapshot& s, const Place& place);
double inertial_share_of_bearing(const HopperSnapshot& s, const Place& place);
double inertial_share_of_bearing_in_shear(const HopperSnapshot& s, const Place& place);
double left_right_imbalance(const HopperSnapshot& s, const Place& place);

/// The stream below the outlet, between heights `from` and `to`, as long as the heap beside it is lower than `free`, or
/// than `from` where that is not given.
double stream_width(const HopperSnapshot& s, const Place& place);
double stream_packing(const HopperSnapshot& s, const Place& place);
double stream_packing_of_cells(const HopperSnapshot& s, const Place& place);
double stream_stripes(const HopperSnapshot& s, const Place& place);
/// Mean vertical stress in the stream over that of the grains above the outlet.
double stream_stress_share(const HopperSnapshot& s, const Place& place);
/// How far the layer on the bin's floor reaches from the middle, mean of left and right: to where the mean packing of
/// the lowest `height` passes 0.15; nan where one side has none.
double foot_reach(const HopperSnapshot& s, const Place& place);

/// Means over x from `left` to `right` at z = `height`.
double hopper_velocity(const HopperSnapshot& s, const Place& place);
double hopper_packing(const HopperSnapshot& s, const Place& place);

// Of the air, where there is any; velocities along z. The cells of the middle layer.
double drag_to_weight(const HopperSnapshot& s, const Place& place);                 ///< height, left, right; all layers
double air_pressure_drop_height(const HopperSnapshot& s, const Place& place);       ///< x, from, to
double air_pressure_gradient_at_drop(const HopperSnapshot& s, const Place& place);  ///< x, from, to
double air_pressure_outside_inside(const HopperSnapshot& s, const Place& place);    ///< height
double air_velocity_within_plug(const HopperSnapshot& s, const Place& place);       ///< height
double air_velocity_beside_plug(const HopperSnapshot& s, const Place& place);       ///< height
double air_velocity_slowness(const HopperSnapshot& s, const Place& place);          ///< height
enum class Half { left, right };
enum class Cells { open, filled };  ///< with hardly any grains; with as many as a stream has, or more
double circulation_in(const HopperSnapshot& s, Where where, Half half, Cells cells);
template <Where where, Half half, Cells cells = Cells::open>
double air_circulation(const HopperSnapshot& s, const Place&) {
  return circulation_in(s, where, half, cells);
}

/// Integral of the curl du_x/dz - du_z/dx of the air's velocity over the cells of its middle layer whose centres lie
/// within the rectangle and which are open, or filled, m^2/s: central differences within the rectangle, one-sided at
/// its rim. Positive: up on the left, to the right above.
double circulation(const GridSnapshot& air, double left, double right, double bottom, double top,
                   Cells cells = Cells::open);

}  // namespace talus::hopper
