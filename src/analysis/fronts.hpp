// SPDX-License-Identifier: Apache-2.0
/// The front of an avalanche: position and speed (Niiya, Awazu & Nishimori 2020, Eq. 10). x points down the slope, z
/// away from it.
#pragma once

#include <optional>
#include <span>

#include "analysis/curve.hpp"
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

}  // namespace talus
