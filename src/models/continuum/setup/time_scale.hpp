// SPDX-License-Identifier: Apache-2.0
/// The time scale of a case, from which windows, limits and averaging times follow unless the case gives them: the time
/// (D/g)^½ in which grains fall through half the width D of the outlet. So a silo of ten metres is measured as one of a
/// laboratory is.
#pragma once

#include "models/continuum/setup/parameters.hpp"

namespace talus::continuum {

/// SI.
struct TimeScales {
  double length = 0;            ///< D: width of the outlet, without one the height of the bed
  double time = 0;              ///< (D/g)^½; without gravity with that of the Earth
  double settled_speed = 0;     ///< settle.speed, or 0.0008 (g D)^½
  double settled_duration = 0;  ///< settle.duration, or 0.3 (D/g)^½
  /// settle.longest, or 15 (L/g)^½, L the larger of D and the height of the bed, after the last inlet that fills the
  /// vessel has ended.
  double settling_limit = 0;
  double averaging_time = 0;  ///< analysis.averaging_time, or 0.3 (D/g)^½

  double peak_time() const { return 0.5 * averaging_time; }  ///< over which peaks are averaged
};
/// Source of the factors: in a laboratory hopper with an outlet of 40 mm they give 0.5 mm/s, 20 ms, 1 s and 20 ms.
TimeScales time_scales_of(const Parameters& parameters);

}  // namespace talus::continuum
