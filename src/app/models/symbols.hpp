// SPDX-License-Identifier: Apache-2.0
/// The symbols and words in the texts of measures (analysis/measure.hpp), as Markdown.
#pragma once

namespace talus::app {

inline constexpr const char* symbols_of_hopper_measures =
    "T is `analysis.averaging_time`: 0.3 (D/g)^½ unless the case gives it, D in that the narrower side of\n"
    "the outlet, without one the height of the bed. t is the time from the opening of the gate, h the\n"
    "spacing of the particles at the start, M the mass of all particles, D and ρ_p diameter and density\n"
    "of the grains; x across, z up from the floor. The *hopper* is what is above the outlet (a slit in a\n"
    "plate, the gap of a wedge), the *bin* what is below it; without an outlet the box is a bin. Q is the\n"
    "mass that passes the outlet's plane per time, of particles smoothed along z by the kernel. *While it\n"
    "flows*: from when a tenth of the mass that passes the outlet in total has passed until half of it\n"
    "has, or half-way between the two; where nothing passes, half of the run. Packing is the kernel sum,\n"
    "including images behind the walls.";

inline constexpr const char* symbols_of_avalanche_measures =
    "a is the mean radius of the case, v_s the speed of one grain alone (Stokes); times are in a/v_s. x\n"
    "points down the slope, y to its left, z away from it. `head_aspect_ratio` is the mean over the\n"
    "second half of a run.";

}  // namespace talus::app
