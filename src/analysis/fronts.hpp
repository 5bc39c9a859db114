// SPDX-License-Identifier: Apache-2.0
/// The front of an avalanche: position, speed (Niiya, Awazu & Nishimori 2020, Eq. 10) and angle against the slope, from
/// the grains on its surface (section 4.3, Figure 11). x points down the
/// slope, z away from it.
#pragma once

#include <optional>
#include <span>

#include "analysis/curve.hpp"
#include "analysis/links.hpp"
#include "base/vector.hpp"

namespace talus {

/// Largest x of a centre, m; nothing without grains.
std::optional<double> front_position(std::span<const Vector3> position);

/// The same of the grains on the slope only: those whose centre is lower than `layer` (2 a for the first layer of
/// section 3.3), m; nothing if there is none.
std::optional<double> front_position_on_slope(std::span<const Vector3> position, double layer);

/// The window of the front speed in the paper's comparison, in a/v_s. Eq. 10 divides by the time step, which is not
/// printed; a displacement over a window does not depend on the step. Choice.
inline constexpr double front_speed_window = 0.25;

/// Displacement of the front between t - window and t over the window; the front is linear between its records.
/// \param front position against time, m and s \returns m/s
/// \throws std::invalid_argument if t - window or t is outside the records
double front_speed(const Curve& front, double t, double window);

/// The front speed at start + window, start + 2 window, ... up to and with `end`, start being the first record's time.
/// \throws std::invalid_argument as front_speed
Curve front_speed_curve(const Curve& front, double window, double end);

/// The grains of the front's surface, from the foremost of the largest cluster upwards, none lower than the one before.
///
/// Links of 4 a make the cluster (choice). The next grain is the one, of those within 3 a and not lower than the
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
