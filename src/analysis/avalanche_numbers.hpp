// SPDX-License-Identifier: Apache-2.0
/// Numbers of one snapshot of a cloud of grains, the material of the measures; nan where they have no meaning, as in
/// another view or without a head. Lengths in m, velocities over v_s, angles in degrees.
#pragma once

#include "analysis/avalanche.hpp"

namespace talus::avalanche {

double head_count(const AvalancheSnapshot& s);
double head_particles(const AvalancheSnapshot& s);  ///< of the largest head
double frontal_angle(const AvalancheSnapshot& s);

/// Of the largest head.
template <double HeadSize::*size>
double head(const AvalancheSnapshot& s) {
  return s.view == AvalancheView::from_above && s.head_size() ? (*s.head_size()).*size : AvalancheRun::none;
}
/// Of a cloud in free space.
template <double FallingCloud::*number>
double of_fall(const AvalancheSnapshot& s) {
  return s.view == AvalancheView::falling ? s.fall().*number : AvalancheRun::none;
}
inline double fall_speed(const AvalancheSnapshot& s) {
  return of_fall<&FallingCloud::fall_speed>(s) / s.scales.stokes_speed;
}

}  // namespace talus::avalanche
