// SPDX-License-Identifier: Apache-2.0
/// Walls of vessels for the tests; lengths in spacings.
#pragma once

#include <array>
#include <numbers>
#include <string>
#include <utility>

#include "models/continuum/cases.hpp"
#include "models/continuum/setup/vessel.hpp"

namespace talus::continuum {

/// Grains in a room without faces, whose size is given in spacings.
inline Parameters room(double x, double y, double z) {
  Parameters p = column(x, y, z);
  p.box.left = p.box.right = p.box.front = p.box.rear = p.box.floor = p.box.top = FaceKind::open;
  return p;
}

inline VesselPart named(std::string name, VesselShape shape) {
  VesselPart part;
  part.name = std::move(name), part.shape = shape;
  return part;
}

inline VesselPart plate(std::string name, std::array<double, 3> corner, std::array<double, 3> first,
                        std::array<double, 3> second) {
  VesselPart part = named(std::move(name), VesselShape::plate);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    part.corner[axis] = corner[axis] * spacing;
    part.first_edge[axis] = first[axis] * spacing;
    part.second_edge[axis] = second[axis] * spacing;
  }
  return part;
}

inline VesselPart disc(std::string name, double radius, double height) {
  VesselPart part = named(std::move(name), VesselShape::disc);
  part.radius = radius * spacing, part.height = height * spacing;
  return part;
}

/// Dry grains in a cone under a cylinder, its outlet shut by the third part, a gate.
inline Parameters shut_silo() {
  Parameters p = room(16, 16, 30);
  make_granular(p);
  VesselPart cylinder = named("cylinder", VesselShape::cylinder), cone = named("cone", VesselShape::cone);
  cylinder.radius = 6 * spacing, cylinder.bottom = 12 * spacing, cylinder.top = 26 * spacing;
  cone.lower_radius = 3 * spacing, cone.upper_radius = 6 * spacing;
  cone.bottom = 6 * spacing, cone.top = 12 * spacing;
  p.vessel = {cylinder, cone, disc("gate", 3, 6)};
  p.vessel[2].gate = true;
  p.bed.height = 8 * spacing;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  return p;
}

/// The same as a sector, of a law with which particles split about the axis.
inline Parameters silo_of_parts(double degrees) {
  Parameters p = shut_silo();
  p.box.sector = degrees * std::numbers::pi / 180;
  p.bed.height = 10 * spacing;
  p.walls.friction_from = FrictionFrom::start;
  granular::CriticalState::Parameters law;
  law.bulk_modulus = 2e5, law.shear_modulus = 1.2e5, law.reference_packing = 0.6;
  p.law = law;
  p.sph.smoothing = Smoothing::local;
  return p;
}

}  // namespace talus::continuum
