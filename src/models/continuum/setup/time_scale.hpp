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
  /// settle.max_time, or 15 (L/g)^½, L the larger of D and the height of the bed, after the last inlet that fills the
  /// vessel has ended.
  double settling_limit = 0;
  double averaging_time = 0;  ///< analysis.averaging_time, or 0.3 (D/g)^½

  double peak_time() const { return 0.5 * averaging_time; }  ///< over which peaks are averaged
};
/// Source of the factors: in a laboratory hopper with an outlet of 40 mm they give 0.5 mm/s, 20 ms, 1 s and 20 ms.
TimeScales time_scales_of(const Parameters& parameters);

/// Time over which gravity comes on while the bed settles: as half a cosine, slower than a wave passes. Laid at the
/// packing at which it just touches, a bed that got its weight at once would be pressed by up to twice of it before it
/// came to rest: overconsolidated, with up to half as much horizontal stress again. A bed whose gate goes by the clock,
/// or that has none, has its weight from the start (docs/design/time-steps.md). Time, s; 0 in a case without settling.
/// \param depth of the grains, m \param sound_speed of pressure waves in the bed, m/s
double loading_time(const Parameters& parameters, double depth, const TimeScales& scales, double sound_speed);

/// Gravity while the bed gets its weight. At once: the same share of it everywhere. In layers: a front rises through
/// the bed; each height gets its weight within a tenth of the loading time once the front has come there.
class Loading {
 public:
  /// \param time over which gravity is raised, s; 0: there from the start \param bottom, depth of the bed, m
  Loading(Filling filling, double time, double bottom, double depth)
      : filling_(filling), time_(time), bottom_(bottom), depth_(depth) {}

  double time() const { return time_; }
  /// Whether the share depends on the height at this time.
  bool is_by_height(double time) const { return filling_ == Filling::layers && time < time_; }
  /// Share of gravity that a particle feels, 0 to 1. \param time from the start, s \param height z, m
  double share(double time, double height) const;

 private:
  Filling filling_;
  double time_, bottom_, depth_;
};

}  // namespace talus::continuum
