// SPDX-License-Identifier: Apache-2.0
/// The curves of the figures of Niiya, Awazu & Nishimori 2020: mean and standard deviation over the members, a colour
/// a radius. Lengths in a, speeds in v_s, times in a/v_s, angles in degrees.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/comparison/evaluation.hpp"
#include "io/figure/chart.hpp"

namespace talus::app {

/// The ensembles of one case that have a run, in the order of their radii.
using Radii = std::vector<const StudiedEnsemble*>;
Radii radii_of(const std::vector<StudiedEnsemble>& ensembles, const std::string& case_name);

/// A number of the snapshots at each of their times: mean and standard deviation over the members that have it.
/// \param first 1: without the start
struct MembersCurve {
  std::vector<double> time, mean, deviation;
};
MembersCurve members_curve(const StudiedEnsemble& ensemble, double AvalancheFrame::*number, std::size_t first = 1);

/// Figures 5a, 6d, 7c. \param printed the range that the text names, low == high: none
figure::Chart front_speeds(const Radii& radii, double printed_low, double printed_high);

figure::Chart head_particles(const Radii& radii);           ///< Figure 9a
figure::Chart head_sizes(const Radii& radii);               ///< Figure 9b
figure::Chart front_speed_of_head(const Radii& radii);      ///< Figure 9c
figure::Chart width_against_thickness(const Radii& radii);  ///< Figure 10a
figure::Chart width_distributions(const Radii& radii);      ///< Figure 10b
figure::Chart width_against_radius(const Radii& radii);     ///< Figure 10c
figure::Chart frontal_angles(const Radii& radii);           ///< Figure 11c

}  // namespace talus::app
