// SPDX-License-Identifier: Apache-2.0
/// A small silo for the tests of what is made of one.
#pragma once

#include <cmath>

#include "models/continuum/setup/parameters.hpp"

namespace talus::app {

/// A cone of 30 degrees under a cylinder of 30 mm, from 60 and 90 mm on, with a lid; friction 0.3.
inline continuum::Parameters small_silo() {
  continuum::Parameters p;
  p.law = granular::YuuUmekageIsotropic::Parameters{};
  p.box.width = p.box.depth = 0.1, p.box.height = 0.2;
  p.bed.spacing = 2.5e-3;
  p.walls.coefficient = 0.3;
  continuum::VesselPart cylinder, cone, lid;
  cylinder.name = "cylinder", cylinder.radius = 0.03, cylinder.bottom = 0.09, cylinder.top = 0.17;
  cone.name = "cone", cone.shape = continuum::VesselShape::cone;
  cone.upper_radius = 0.03, cone.lower_radius = 0.03 - 0.03 * std::tan(continuum::half_turn / 6);
  cone.bottom = 0.06, cone.top = 0.09;
  lid.name = "lid", lid.shape = continuum::VesselShape::disc, lid.radius = cone.lower_radius, lid.height = 0.06;
  lid.gate = true;
  p.vessel = {cylinder, cone, lid};
  return p;
}

}  // namespace talus::app
