// SPDX-License-Identifier: Apache-2.0
/// From where particles are looked at: orthographic projections, so that a length in the picture's plane is to scale
/// everywhere. The slope is the plane z = 0; x runs down it, y across, z away from it.
#pragma once

#include <cmath>

#include "base/vector.hpp"

namespace talus::figure {

/// Three orthogonal directions of length 1: right and up on the page, and out of it towards the eye.
struct View {
  Vector3 right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};
};

/// On the slope from above, x to the right.
inline constexpr View view_xy{};
/// Along the slope from the side, x to the right, the slope drawn level.
inline constexpr View view_xz{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};

/// From the side, turned by `azimuth` about the slope's normal and raised by `elevation` above the slope (both in rad).
inline View view_oblique(double azimuth, double elevation) {
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
  return {{ca, sa, 0}, {-se * sa, se * ca, ce}, {ce * sa, -ce * ca, se}};
}

/// What of a view's direction is an axis: "x", "y" or "z" and the sign, or no name where it is oblique.
struct AxisName {
  const char* name = nullptr;
  double sign = 1;
};

inline AxisName axis_of(const Vector3& direction) {
  const double components[] = {direction.x, direction.y, direction.z};
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    if (std::abs(components[k]) == 1.0) return {names[k], components[k]};
  }
  return {};
}

}  // namespace talus::figure
