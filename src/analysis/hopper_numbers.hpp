// SPDX-License-Identifier: Apache-2.0
/// Numbers of one snapshot of grains in a vessel, the material of the measures; nan where they have no meaning. SI,
/// angles in degrees. Estimators: validation/yuu2011/reference.toml.
#pragma once

#include <numbers>

#include "analysis/free_surface.hpp"
#include "analysis/hopper.hpp"

namespace talus::hopper {

enum class Where { bin, hopper };                                     ///< below the outlet, and above it
const FreeSurface& surface_in(const HopperSnapshot& s, Where where);  ///< empty if there is no hopper
ReposeAngle repose_in(const HopperSnapshot& s, Where where);

template <Where where>
double surface_angle_in(const HopperSnapshot& s) {
  return surface_angle(surface_in(s, where), s.shape().middle()) / (std::numbers::pi / 180);
}
template <Where where, double ReposeAngle::*angle>
double repose_angle_in(const HopperSnapshot& s) {
  return repose_in(s, where).*angle / (std::numbers::pi / 180);
}
template <double GradientSizes::*size>
double gradient(const HopperSnapshot& s) {
  return s.gradient_sizes().*size;
}
double mass(const HopperSnapshot& s);  ///< of all particles
double quiescent_speed(const HopperSnapshot& s);
double packing_max(const HopperSnapshot& s);
double density_drift(const HopperSnapshot& s);
double stress_ratio(const HopperSnapshot& s);
double inertial_share(const HopperSnapshot& s);
double left_right_imbalance(const HopperSnapshot& s);

}  // namespace talus::hopper
