// SPDX-License-Identifier: Apache-2.0
/// A straight plate without thickness between two places of the x-z plane, through the whole depth: a wall of a wedge
/// hopper, a chute, a partition. It has openings along its length; a gate is one that is shut at first.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/vector.hpp"

namespace talus {

struct Panel {
  struct Opening {
    double begin = 0, end = 0;  ///< along the panel, from its first end, m
    bool shut = false;          ///< a gate that is still there: solid
    double opens_after = 0;     ///< from the opening of the gate of the case, s
  };
  std::string name;
  Vector3 from, to;  ///< m; y has no meaning
  std::vector<Opening> openings = {};

  double length() const { return std::hypot(to.x - from.x, to.z - from.z); }
  Vector3 along() const { return (1 / length()) * Vector3{to.x - from.x, 0, to.z - from.z}; }
  Vector3 normal() const { return {-along().z, 0, along().x}; }  ///< unit

  /// Distance from the panel's plane, to the side of its normal, m.
  double above(const Vector3& x) const { return dot(normal(), x - from); }

  /// Distance from the panel itself, openings filled, m.
  double distance(const Vector3& x) const {
    const double s = std::clamp(share(x), 0.0, 1.0);
    return std::hypot(x.x - from.x - s * (to.x - from.x), x.z - from.z - s * (to.z - from.z));
  }

  /// Whether it is solid at a distance along it. Ends and rims belong to the panel; neighbours overlap by rounding.
  bool is_solid(double s) const {
    const double slack = 1e-9 * length();
    if (!(s >= -slack && s <= length() + slack)) return false;
    return std::none_of(openings.begin(), openings.end(),
                        [&](const Opening& o) { return !o.shut && s > o.begin && s < o.end; });
  }

  /// The share of the way from a to b at which it meets the solid panel; nothing if it does not.
  std::optional<double> meets(const Vector3& a, const Vector3& b) const {
    const double side_a = turn_to(a), side_b = turn_to(b);
    if ((side_a >= 0) == (side_b >= 0)) return std::nullopt;
    const double t = side_a / (side_a - side_b);
    if (!is_solid(share(a + t * (b - a)) * length())) return std::nullopt;
    return t;
  }

 private:
  /// Above 0 on the side of the normal.
  double turn_to(const Vector3& x) const { return (to.x - from.x) * (x.z - from.z) - (to.z - from.z) * (x.x - from.x); }
  /// How far along the panel, as a share of its length.
  double share(const Vector3& x) const {
    const double dx = to.x - from.x, dz = to.z - from.z;
    return (dx * (x.x - from.x) + dz * (x.z - from.z)) / (dx * dx + dz * dz);
  }
};

}  // namespace talus
