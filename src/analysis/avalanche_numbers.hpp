// SPDX-License-Identifier: Apache-2.0
/// Numbers of one snapshot of a cloud of grains, the material of the measures; nan where they have no meaning, as in
/// another view or without a head. Lengths in m, velocities over v_s, curls over v_s/a, angles in degrees.
#pragma once

#include "analysis/avalanche.hpp"

namespace talus::avalanche {

inline double front_speed(const AvalancheSnapshot& s, const Place&) {
  return s.front_speed / s.scales.stokes_speed;
}

double head_count(const AvalancheSnapshot& s, const Place& place);
double head_particles(const AvalancheSnapshot& s, const Place& place);  ///< of the largest head
double front_rear_thickness_ratio(const AvalancheSnapshot& s, const Place& place);
double frontal_angle(const AvalancheSnapshot& s, const Place& place);
double displacement_spread(const AvalancheSnapshot& s, const Place& place);  ///< since the start of the run
double displacement_lateral(const AvalancheSnapshot& s, const Place& place);

/// Of the largest head.
template <double HeadSize::*size>
double head(const AvalancheSnapshot& s, const Place&) {
  return s.view == AvalancheView::from_above && s.head_size() ? (*s.head_size()).*size : AvalancheRun::none;
}
template <double HeadMotion::*velocity>
double head_motion(const AvalancheSnapshot& s, const Place&) {
  return s.view == AvalancheView::from_above ? s.head_motion().*velocity / s.scales.stokes_speed : AvalancheRun::none;
}
template <double HeadMotion::*curl>
double head_curl(const AvalancheSnapshot& s, const Place&) {
  return s.view == AvalancheView::from_above ? s.head_motion().*curl * s.scales.mean_radius / s.scales.stokes_speed
                                             : AvalancheRun::none;
}

/// Of head and tail, seen from the side.
template <double HeadTailMotion::*velocity>
double parts_motion(const AvalancheSnapshot& s, const Place&) {
  return s.view == AvalancheView::from_the_side ? s.head_tail_motion().*velocity / s.scales.stokes_speed
                                                : AvalancheRun::none;
}

/// Of a cloud in free space.
template <double FallingCloud::*number>
double of_fall(const AvalancheSnapshot& s, const Place&) {
  return s.view == AvalancheView::falling ? s.fall().*number : AvalancheRun::none;
}
inline double fall_speed(const AvalancheSnapshot& s, const Place& place) {
  return of_fall<&FallingCloud::fall_speed>(s, place) / s.scales.stokes_speed;
}

}  // namespace talus::avalanche
