// SPDX-License-Identifier: Apache-2.0
/// Where things stand: the box with its plates and walls, and the particles of the bed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/domain.hpp"

namespace talus::continuum {

struct Parameters;

/// The slit of the plate, the outlet of the wedge or the lowest of the vessel's: what the grains leave through.
struct Outlet {
  double height, left, right;  ///< m
  double across;               ///< its narrower side; of a slit between mirrors its width, m
  double middle_y;             ///< m
};
std::optional<Outlet> outlet_of(const Parameters& parameters);

/// Where the lattice of the bed begins and ends along x and y, and its bottom, m: the box, or the vessel where it
/// stands apart from the faces of the box.
struct Extent {
  double low, high;
};
Extent bed_along_x(const Parameters& parameters);
Extent bed_along_y(const Parameters& parameters);
double bed_bottom(const Parameters& parameters);

/// The case with one bed only: 0 that of [bed], from 1 on those of [[beds]].
Parameters with_bed_alone(const Parameters& parameters, std::size_t bed);
/// The numbers of beds that hold particles.
std::vector<std::size_t> beds_of(const Parameters& parameters);
/// Whether no particle is there at the start: grains come in through an inlet only.
bool has_no_bed(const Parameters& parameters);
/// How deep grains can lie: the height from the bottom of all beds to their top; without a bed that of vessel or box
/// above the bed's bottom, m.
double depth_of_grains(const Parameters& parameters);

/// The sector that the case computes, about the upright axis through the middle of the box; none: the whole box.
std::optional<Sector> sector_of(const Parameters& parameters);
/// How many such sectors make up the whole; without a sector 1.
int copies_of(const Parameters& parameters);

/// The box and the walls in it, with their gates shut unless there are none.
Domain domain_of(const Parameters& parameters);

/// How far a wall from face to face is from others at least, to be a layer of the domain, m.
double least_distance_of_layers(const Parameters& parameters);

/// The lattice on which the particles stand at the start, those of the first bed where there are several.
struct Lattice {
  Vector3 corner;                     ///< of the bed, m
  Vector3 spacing;                    ///< m, close to bed.spacing
  std::array<std::int64_t, 3> count;  ///< particles along x, y, z
  double mass;  ///< of a particle, kg: the bed's mass is its volume times packing and grain density
                ///< (in a sector the layers of the lattice are rings, vessel_bed.cpp); without a bed, and of bed.file,
                ///< that of a cube of bed.spacing
};
Lattice lattice_of(const Parameters& parameters);

/// Where the particles stand at the start, bed by bed: those of bed.file, or the places of the lattice that bed.inside
/// or the middle of the bed's top sees, no plate between, and farther than a quarter of the spacing from plates at any
/// angle. Of a sector those that are within it.
std::vector<Vector3> bed_positions(const Parameters& parameters);

/// Places of a lattice, whether or not a plate hides them.
double places_of(const Lattice& lattice);

/// Number of those particles, without placing them; exact unless plates stand in a bed of more than a million places
/// a layer, of which then only some are looked at.
double bed_count(const Parameters& parameters);

}  // namespace talus::continuum
