// SPDX-License-Identifier: Apache-2.0
/// The symbols and words in the texts of measures (analysis/measure.hpp), as Markdown.
#pragma once

namespace talus::app {

inline constexpr const char* symbols_of_hopper_measures =
    "T is `analysis.averaging_time`: 0.3 (D/g)^½ unless the case gives it, D in that the narrower side of the\noutlet, "
    "without one the height of the bed. t is the time from the opening of the gate, h the spacing of the particles at "
    "the start, M the mass\nof all "
    "particles, D and ρ_p diameter and density of the grains; x across, z up from the floor. The\n*hopper* is what "
    "is above the outlet (a slit in a plate, the gap of a wedge), the *bin* what is\nbelow it; without an outlet the "
    "box is a bin. Q is the mass that passes the outlet's plane per\ntime, of particles smoothed along z by the "
    "kernel. *While it flows*: from when a tenth of the mass\nthat passes the outlet in total has passed until half "
    "of it has, or half-way between the two; where\nnothing passes, half of the run. Packing is the kernel sum, "
    "including images behind the walls; a\nvalue at a place is interpolated by the kernel to the centre of the "
    "cell, three quarters of a\nspacing wide, that contains it.";

inline constexpr const char* symbols_of_avalanche_measures =
    "a is the mean radius of the case, v_s the speed of one grain alone (Stokes); times are in a/v_s. x\n"
    "points down the slope, y to its left, z away from it. `head_aspect_ratio` is the mean over the\n"
    "second half of a run.";

}  // namespace talus::app
