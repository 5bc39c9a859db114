// SPDX-License-Identifier: Apache-2.0
/// Flat walls of every kind that fall along x at an angle, and particles on them.
#pragma once

#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "models/continuum/drawn_parts.hpp"
#include "models/continuum/few_particles.hpp"
#include "models/continuum/vessel_parts.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

using std::numbers::pi;

inline constexpr double gravity = 9.81;
inline constexpr double rest = sph::contact_distance * spacing;

/// Grains in a room of a size in spacings, whose walls rub from the start.
inline Parameters rubbing_room(double x, double y, double z) {
  Parameters p = room(x, y, z);
  make_granular(p);
  p.integration.method = Method::leapfrog;
  p.integration.courant = 0.6;
  p.walls.friction_from = FrictionFrom::start;
  return p;
}

/// One that is large, and what its bed is made of.
inline Parameters large_room() {
  Parameters p = rubbing_room(120, 12, 100);
  p.bed.height = 2 * spacing;
  return p;
}

/// A flat boundary that falls along x at an angle, through `foot`.
struct Incline {
  std::string name;
  std::function<Parameters(double angle, const Vector3& foot)> make;
};

inline const Vector3 foot{20 * spacing, 6 * spacing, 60 * spacing};

inline Vector3 down(double angle) {
  return {std::cos(angle), 0, -std::sin(angle)};
}
inline Vector3 up(double angle) {
  return {std::sin(angle), 0, std::cos(angle)};
}

/// \param begin, end along the incline, from the foot, m
inline VesselPart plate_of_vessel(double angle, const Vector3& at, double begin, double end) {
  VesselPart part = named("plate", VesselShape::plate);
  const Vector3 corner = at + begin * down(angle), edge = (end - begin) * down(angle);
  part.corner = {corner.x, -6 * spacing, corner.z};
  part.first_edge = {edge.x, 0, edge.z};
  part.second_edge = {0, 24 * spacing, 0};
  return part;
}

inline const std::vector<Incline>& inclines() {
  static const std::vector<Incline> all{
      {"face",
       [](double, const Vector3&) {
         Parameters p = large_room();
         p.box.floor = FaceKind::wall;
         return p;
       }},
      {"plate",
       [](double angle, const Vector3& at) {
         Parameters p = large_room();
         const Vector3 from = at - 15 * spacing * down(angle), to = at + 60 * spacing * down(angle);
         InclinedPlate plate;
         plate.from = {from.x, from.z}, plate.to = {to.x, to.z};
         p.plates = {plate};
         return p;
       }},
      {"plate of a vessel",
       [](double angle, const Vector3& at) {
         Parameters p = large_room();
         p.vessel = {plate_of_vessel(angle, at, -15 * spacing, 60 * spacing)};
         return p;
       }},
      {"closed sheet", [](double angle, const Vector3& at) {
         Parameters p = large_room();
         const Vector3 corner = at - 15 * spacing * down(angle) - Vector3{0, 12 * spacing, 0};
         p.vessel = {drawn("sheet", sheet(corner, 75 * spacing * down(angle), {0, 24 * spacing, 0}, 0.1 * spacing))};
         return p;
       }}};
  return all;
}

/// Of a boundary, with particles on it that move down at a speed. \param height above it, in contact distances
inline std::vector<PlacedParticle> row_on(double angle, const Vector3& at, int count, double speed) {
  std::vector<PlacedParticle> row;
  for (int n = 0; n < count; ++n)
    row.push_back({at + rest * up(angle) + Vector3{0, (n - 0.5 * (count - 1)) * spacing, 0}, speed * down(angle)});
  return row;
}

}  // namespace talus::continuum
