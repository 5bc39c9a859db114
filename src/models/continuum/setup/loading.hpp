// SPDX-License-Identifier: Apache-2.0
/// How the weight of a bed that settles comes on. Laid at the packing at which it just touches, a bed that got its
/// weight at once would be pressed by up to twice of it before it came to rest: overconsolidated, with up to half as
/// much horizontal stress again. So the weight comes on as half a cosine, slower than a wave passes; a bed whose gate
/// goes by the clock, or that has none, has it all. docs/design/time-steps.md
#pragma once

#include "models/continuum/setup/time_scale.hpp"

namespace talus::continuum {

/// Time over which gravity comes on while the bed settles, s; 0 in a case without settling.
/// \param depth of the grains, m \param sound_speed of pressure waves in the bed, m/s
double loading_time(const Parameters& parameters, double depth, const TimeScales& scales, double sound_speed);

/// Share of gravity that the bed feels, 0 to 1, at a time from the start, s.
double share_of_gravity(double time, double loading_time);

}  // namespace talus::continuum
