// SPDX-License-Identifier: Apache-2.0
/// What formulas for silos take from a vessel: its upright walls, and the hoppers that narrow downwards.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "models/continuum/setup/layout.hpp"

namespace talus::app {

/// Walls between two heights that are upright, or that narrow downwards at one angle. Lengths in m.
struct SiloPiece {
  double bottom = 0, top = 0;
  double area = 0, circumference = 0;  ///< A and U at the top, m^2, m: what planes of symmetry cut off does not count
  double width = 0;                    ///< diameter of the circle inscribed at the top
  double tangent = 0;                  ///< of the angle between walls and vertical, 0: upright
  bool is_round = false;
  double friction = 0;             ///< of the walls, mean over U
  Vector3 axis;                    ///< a place on it
  std::vector<std::size_t> parts;  ///< of the vessel

  bool is_hopper() const { return tangent > 0; }
  double hydraulic_radius() const { return area / circumference; }
  /// The height at which the walls of a hopper would meet.
  double apex() const { return top - 0.5 * width / tangent; }
  /// S of a hopper, whose section grows as x^S with the height x above the apex: U d_c/(2A), 2 of cones and square
  /// pyramids, 1 of wedges, 1 + b/a of rectangles.
  double shape() const { return 0.5 * circumference * width / area; }
  bool has(std::size_t part) const;
};

/// The pieces of a vessel, the lowest first. Cylinders, boxes and cones on an upright axis are one each; where plates,
/// pyramids and triangles of files stand, rays find the section of the vessel level by level: of a section that is seen
/// whole from within area and circumference to round-off of its corners.
class SiloShape {
 public:
  /// \param layout outlives it
  SiloShape(const continuum::Layout& layout);  // NOLINT(google-explicit-constructor): what a layout says of its silo

  const continuum::Layout& layout;
  std::vector<SiloPiece> pieces;

  /// The piece that a part of the vessel belongs to at a height, or at most a spacing from it; null: none.
  const SiloPiece* of_part(std::size_t part, double height) const;
  /// The upright walls that enclose a place, or stand next above it; where none enclose its x and y, the lowest that
  /// reach its height. Of walls within walls the inner ones if an outlet is within them. Null without, and where the
  /// bed stands between both. \param place m
  const SiloPiece* upright_at(const Vector3& place) const;
  /// Where the walls of a silo end: with those that stand under these, at a hopper of their width or a level floor,
  /// which closes more than half of the section, within them. \param top of the bed, m \returns m
  double bottom_of(const SiloPiece& wall, double top) const;
  /// Walls of one silo, ring above ring, from the bed's top down to a height.
  struct Ring {
    double friction = 0, height = 0;  ///< height: of the bed that the ring holds, m
  };
  std::vector<Ring> rings_above(const SiloPiece& wall, double height, double top) const;
  /// The names of a piece's parts: "wall_left, wall_right".
  std::string name_of(const SiloPiece& piece) const;
};

/// Of a part of the vessel, `layout.given.vessel[n]`.
double friction_of(const continuum::Layout& layout, const continuum::VesselPart& part);
/// Packing times density of the grains, kg/m^3.
double bulk_density(const continuum::Parameters& parameters);
/// Of the angle between a cone's wall and the vertical.
double tangent_of(const continuum::VesselPart& cone);
/// A cone that narrows downwards.
bool is_cone(const continuum::VesselPart& part);

/// The section that walls of plates, pyramids and files enclose at a height; its bottom and top are that height.
/// Nothing where other walls, an open face or none are met, or walls of several angles.
std::optional<SiloPiece> section_by_rays(const continuum::Layout& layout, double height);

}  // namespace talus::app
