// SPDX-License-Identifier: Apache-2.0
/// Where the bed lies, and what is wrong with it there.
#pragma once

#include <string>
#include <vector>

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

}  // namespace talus::continuum
