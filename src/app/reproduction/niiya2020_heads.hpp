// SPDX-License-Identifier: Apache-2.0
/// How the sizes of heads vary, in the manner of Figures 9c and 10 of Niiya, Awazu & Nishimori 2020: mean and standard
/// deviation over the members, or over all heads of all members.
#pragma once

#include "app/reproduction/niiya2020_curves.hpp"

namespace talus::app {

figure::Chart front_speed_of_head(const Radii& radii);      ///< Figure 9c
figure::Chart width_against_thickness(const Radii& radii);  ///< Figure 10a
/// Figure 10b: densities in bins of 2 a, and the Gaussian nearest to that of the largest radius.
figure::Chart width_distributions(const Radii& radii);
/// Figure 10c, without the experiments: their data are not printed. \param radii at least two, for the line
figure::Chart width_against_radius(const Radii& radii);
/// The rectangle's heads at the end and the numbers that section 4.2 prints.
figure::Chart head_counts(const Radii& radii);

}  // namespace talus::app
