// SPDX-License-Identifier: Apache-2.0
/// What the air of a case is: an incompressible gas between grains (Yuu & Umekage 2011, Eqs 18-21). SI; the initial
/// values are the defaults.
#pragma once

#include "numerics/grid/passages.hpp"
#include "physics/air/gas.hpp"
#include "physics/coupling/drag.hpp"

namespace talus::air {

enum class Motion {
  flowing,  ///< Eqs 18 and 19
  frozen    ///< at rest and everywhere at one pressure: it only drags
};

struct Parameters {
  double pressure = 101325;     ///< of the surroundings, Pa
  double temperature = 293.15;  ///< K
  double viscosity = 1.82e-5;   ///< Pa s
  Motion motion = Motion::flowing;
  coupling::DragLaw drag = coupling::DragLaw::schiller_naumann_umekage_yuu;
  double grain_diameter = 200e-6;  ///< m
  double grain_density = 2500;     ///< kg/m^3
  double upwind = 0.25;   ///< upstream weight of convection: 0 the printed central scheme, 1 third-order upstream
  double courant = 0.5;   ///< most that the air moves in a step, cells
  double response = 0.1;  ///< most of the time step over the time in which the pressure stops the grains' dilation
  double longest_step = 100e-6;  ///< s
  double tolerance = 1e-6;       ///< of the pressure equation, relative
  FlowBoundaries boundaries;

  double density() const { return air::density(pressure, temperature); }
  coupling::DragMedium medium() const {
    return {.density = density(),
            .viscosity = viscosity,
            .diameter = grain_diameter,
            .slip_factor = slip_factor(mean_free_path(viscosity, pressure, temperature), grain_diameter)};
  }
};

}  // namespace talus::air
