// SPDX-License-Identifier: Apache-2.0
/// A solid plate without thickness across the whole box, with rectangular openings. A gate is an opening that is shut
/// at first.
#pragma once

#include <algorithm>
#include <vector>

#include "base/vector.hpp"

namespace talus {

struct Opening {
  Vector3 low, high;  ///< m; the component along the plate's axis has no meaning
  bool shut = false;  ///< a gate that is still there: solid
};

struct Plate {
  int axis = 2;         ///< of its normal
  double position = 0;  ///< along the axis, m
  std::vector<Opening> openings;

  /// Whether the plate is solid at a point of its plane. An opening's rim belongs to the plate.
  bool is_solid(const Vector3& point) const {
    return std::none_of(openings.begin(), openings.end(), [&](const Opening& opening) {
      if (opening.shut) return false;
      for (int a = 0; a < 3; ++a)
        if (a != axis && !(point[a] > opening.low[a] && point[a] < opening.high[a])) return false;
      return true;
    });
  }

  /// Side of a point: 0 below the plate's plane, 1 on it or above.
  int side_of(const Vector3& point) const { return point[axis] >= position; }
};

}  // namespace talus
