// SPDX-License-Identifier: Apache-2.0
/// Where the surface of a file ends below the surface of the bed: a hole, or an outlet without a gate.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector.hpp"

namespace talus::continuum {

struct Layout;

/// What of a rim is open.
struct OpenRim {
  std::size_t part;      ///< of the vessel
  Vector3 middle;        ///< m
  double length, width;  ///< the two largest extents along x, y and z, m
};

/// The closed rims of the STL parts around which grains of the bed leave the vessel while its gates are shut: along at
/// least two spacings, or half of the rim, there are grains on one side of the surface only, a spacing below the top of
/// the bed or deeper, and nothing blocks the way around the edge at 0.6 spacings from it, neither another part nor a
/// face of the box that is not open. So the top of a vessel, an outlet on a gate, a plate within the bed and gaps
/// narrower than that are none. The bed is laid with these rims closed for that.
std::vector<OpenRim> rims_below_bed(const Layout& layout);

}  // namespace talus::continuum
