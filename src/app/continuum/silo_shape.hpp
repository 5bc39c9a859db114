// SPDX-License-Identifier: Apache-2.0
/// What formulas for silos take from a vessel: its upright walls, its cones, and the friction of each.
#pragma once

#include "models/continuum/setup/layout.hpp"

namespace talus::app {

/// Of a part of the vessel, `layout.given.vessel[n]`.
double friction_of(const continuum::Layout& layout, const continuum::VesselPart& part);
/// Packing times density of the grains, kg/m^3.
double bulk_density(const continuum::Parameters& parameters);
/// Of the angle between a cone's wall and the vertical.
double tangent_of(const continuum::VesselPart& cone);
/// A cone that narrows downwards.
bool is_hopper(const continuum::VesselPart& part);
/// Area over circumference of upright walls, m; 0 for others.
double hydraulic_radius(const continuum::VesselPart& part);
/// The upright walls that hold a height, or stand next above it; null without.
const continuum::VesselPart* upright_at(const continuum::Parameters& parameters, double height);

}  // namespace talus::app
