// SPDX-License-Identifier: Apache-2.0
/// Where the bed lies, and what is wrong with it there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/vector.hpp"
#include "models/continuum/setup/layout.hpp"
#include "numerics/run_record.hpp"

namespace talus::continuum {

struct BedReport {
  double particles = 0, mass = 0;   ///< of the whole bed, kg
  Vector3 low, high;                ///< corners of the box around it, half a spacing beyond its particles, m
  std::vector<std::string> beside;  ///< the walls and faces that it lies against
};
/// Of a bed of millions of particles those of a coarser one are looked at. \pre the parameters are valid, no [[beds]]
BedReport report_of_bed(const Layout& layout);

/// Warnings of beds in a vessel: the region of one passes out of the vessel, lies outside all walls, or none is above a
/// gate. The region passes out where it reaches beyond the vessel's extent along x or y, which bounds a bed by default,
/// or below its bottom while gates are shut; the place is the narrowest of the widest way out. \pre the parameters are
/// valid
std::vector<RegimeLine> regime_of_bed(const Layout& layout);

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
