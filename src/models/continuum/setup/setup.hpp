// SPDX-License-Identifier: Apache-2.0
/// What follows from the keys of a case, found once before its run and constant from then on: the layout, the law with
/// its speed of sound, the time scales.
#pragma once

#include "models/continuum/material.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/setup/time_scale.hpp"

namespace talus::continuum {

struct Setup : Layout {
  /// \pre check() finds nothing
  explicit Setup(const Parameters& parameters) : Setup(Layout(parameters)) {}
  explicit Setup(Layout layout);

  double density;           ///< bulk density of the bed, kg/m^3
  Material material;        ///< the law
  double sound_speed;       ///< of pressure waves in the bed, a bound for the time step, m/s
  double smoothing_length;  ///< in the bed, m
  TimeScales scales;
  Loading loading;  ///< how gravity is raised
};

}  // namespace talus::continuum
