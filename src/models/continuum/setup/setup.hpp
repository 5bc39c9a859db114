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

  /// Artificial viscosity at the outlet: alpha times speed of sound and smoothing length, over D (g D)^½ with D the
  /// width of the outlet. It takes viscous_loss times itself of a discharge; nan without an outlet.
  /// \param alpha as sph.viscosity_alpha
  double viscosity_at_outlet(double alpha) const;
  /// sph.viscosity_alpha where a case gives none: 0.1, or what makes viscosity_at_outlet max_viscosity, if that is
  /// less; at least 0.01.
  double default_viscosity() const;
};

/// Share of the discharge that a viscosity at the outlet of 1 takes. Source: validation/plant.
inline constexpr double viscous_loss = 0.17;
/// Of a viscosity that nobody chose, at the outlet.
inline constexpr double max_viscosity = 0.1;

}  // namespace talus::continuum
