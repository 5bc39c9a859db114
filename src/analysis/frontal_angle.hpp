// SPDX-License-Identifier: Apache-2.0
/// Angle of an avalanche's front against the slope, from the grains on its surface (Niiya, Awazu & Nishimori 2020,
/// section 4.3, Figure 11). x points down the slope, z away from it.
#pragma once

#include <optional>
#include <span>

#include "analysis/links.hpp"
#include "base/vector.hpp"

namespace talus {

/// The grains of the front's surface, from the foremost of the largest cluster upwards, none lower than the one before.
///
/// The cluster is that of links of 4 a (choice). The next grain is the one, of those within 3 a and not lower than the
/// last, that lies at the smallest angle from +x (section 4.3 gives the range of 0 to 180 degrees, not the order:
/// choice; of equal ones the nearest). The walk ends where there is none. \param position m; the foremost of equal ones
/// is the lowest \param mean_radius of the case, > 0, m
GrainSet surface_walk(std::span<const Vector3> position, double mean_radius);

/// Angle between the slope behind the front and the line nearest to the grains' centres, 0 to pi: below pi/2 the front
/// leans back. Nothing for fewer than three grains, or if they prefer no direction.
///
/// The line has the least sum of squared distances (orthogonal regression). A line of z on x has no meaning for an
/// upright front, one of x on z leans to the upright; this one turns with the grains and prefers no axis. Choice.
std::optional<double> angle_of_line(std::span<const Vector3> position, const GrainSet& grains);

}  // namespace talus
