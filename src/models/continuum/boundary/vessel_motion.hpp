// SPDX-License-Identifier: Apache-2.0
/// Walls whose surface moves while the wall stays where it is: bodies of revolution that turn about their own axis,
/// tubes that slide along it, and belts. They move from the opening of the gate of the case on.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/vector.hpp"
#include "models/continuum/setup/parameters.hpp"

namespace talus::continuum {

/// Whether the surface of a wall of the vessel moves.
bool is_moving(const VesselPart& part);

/// Its velocity as if it filled all space, m/s: of a turning one omega x (place - axis), of a tube along its
/// axis.
Vector3 velocity_of_wall(const Parameters& parameters, std::size_t part, const Vector3& place);

/// A belt that would leave its plane.
void check_motion(const VesselPart& part, std::size_t number, std::vector<Problem>& problems);

}  // namespace talus::continuum
