// SPDX-License-Identifier: Apache-2.0
/// Curves of the figures of Niiya, Awazu & Nishimori 2020 against time: mean and standard deviation over the members, a
/// colour and a symbol a radius. Lengths in a, speeds in v_s, times in a/v_s, angles in degrees.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/cloud/avalanche_ensembles.hpp"
#include "io/figure/chart.hpp"

namespace talus::app {

/// The ensembles of one case that have a run with snapshots, in the order of their radii.
using Radii = std::vector<const AvalancheEnsemble*>;
Radii radii_of(const std::vector<AvalancheEnsemble>& ensembles, const std::string& case_name);

/// A number of the snapshots at each of their times: mean and standard deviation over the members that have it.
struct MembersCurve {
  std::vector<double> time, mean, deviation;
};
using FrameNumber = std::function<double(const AvalancheFrame&)>;
/// \param first 1: without the start
MembersCurve members_curve(const AvalancheEnsemble& ensemble, const FrameNumber& number, std::size_t first = 1);
/// The same of a length in m, in a.
MembersCurve members_curve_in_radii(const AvalancheEnsemble& ensemble, const FrameNumber& length,
                                    std::size_t first = 1);

/// "a_p = 5 mm".
std::string label_of(const AvalancheEnsemble& ensemble);
/// Points of one colour and symbol a radius, x and y with what error bars there are. \param k number of the radius
figure::Points points_of_radius(const AvalancheEnsemble& ensemble, std::size_t k, bool open = false);

/// Figures 5a, 6d, 7c. \param printed the range that the text names, low == high: none
figure::Chart front_speeds(const Radii& radii, double printed_low, double printed_high);

/// One of several numbers in a chart; its symbols are filled or open.
struct DrawnNumber {
  FrameNumber number;
  std::string label = {};  ///< needed only for one of several
  bool open = false;
  bool in_radii = false;  ///< m, drawn in a
};
/// Numbers of the snapshots against time. \param first as in members_curve
figure::Chart over_time(const Radii& radii, figure::Axis axis, const std::vector<DrawnNumber>& numbers,
                        std::size_t first = 1);

figure::Chart head_particles(const Radii& radii);      ///< Figure 9a
figure::Chart head_sizes(const Radii& radii);          ///< Figure 9b
figure::Chart head_aspect_ratios(const Radii& radii);  ///< width over thickness, of which the text says 4
figure::Chart thickness_ratios(const Radii& radii);    ///< front over rear, of which section 3.3 says more than 2
figure::Chart frontal_angles(const Radii& radii);      ///< Figure 11c

figure::Chart head_curls(const Radii& radii);     ///< both halves of the head (Figure 5b)
figure::Chart head_motions(const Radii& radii);   ///< its rear and its front (Figure 5b)
figure::Chart layer_motions(const Radii& radii);  ///< upper and lower head (Figure 7a)
figure::Chart tail_motions(const Radii& radii);   ///< the tail (Figure 7a)

}  // namespace talus::app
