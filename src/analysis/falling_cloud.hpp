// SPDX-License-Identifier: Apache-2.0
/// A cloud of grains that falls freely through a viscous fluid: how fast, how much it leaves behind, and whether it has
/// become a torus. Compare Metzger, Nicolas & Guazzelli, J. Fluid Mech. 580, 283-301 (2007), who describe the leakage
/// from the rear and the torus; the measures here are choices.
#pragma once

#include <span>

#include "base/vector.hpp"

namespace talus {

struct FallingCloud {
  double fall_speed = 0;       ///< mean velocity along gravity of the grains of the cloud, m/s
  double leaked_fraction = 0;  ///< share of the grains more than two initial radii behind the median of all
  /// Number of grains of the cloud within 0.3 of its lateral radius from its axis, over what a disc of even density
  /// would have there: 1.27 for an even sphere, below 1 with a hole. The lateral radius holds 90 % of the grains.
  double axial_density = 0;
  double flatness = 0;  ///< root mean square lateral distance, over sqrt(2) times that along gravity: 1 for a sphere
};

/// \param position, velocity m, m/s, one per grain, at least one \param gravity unit vector
/// \param initial_radius of the cloud, m
FallingCloud measure_falling_cloud(std::span<const Vector3> position, std::span<const Vector3> velocity,
                                   const Vector3& gravity, double initial_radius);

}  // namespace talus
