// SPDX-License-Identifier: Apache-2.0
/// Where things are in a case: the boundary, the outlets, and the particles of its beds.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "base/vector.hpp"
#include "models/continuum/boundary/boundary.hpp"
#include "models/continuum/boundary/vessel_outlets.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "numerics/geometry/sector.hpp"

namespace talus::continuum {

/// The slit of the plate, the outlet of the wedge or the lowest of the vessel's: what the grains leave through.
struct Outlet {
  double height, left, right;  ///< m
  double across;               ///< its narrower side; of a slit between mirrors its width, m
  double middle_y;             ///< m
};

/// The lattice of the particles at the start, those of the first bed where there are several.
struct Lattice {
  Vector3 corner;                     ///< of the bed, m
  Vector3 spacing;                    ///< m, close to bed.spacing
  std::array<std::int64_t, 3> count;  ///< particles along x, y, z
  double mass;  ///< of a particle, kg: the bed's mass is its volume times packing and grain density
                ///< (in a sector the layers of the lattice are rings, vessel_bed.cpp); without a bed, and of bed.file,
                ///< that of a cube of bed.spacing

  /// Positions of the lattice, whether or not a plate hides them.
  double positions() const {
    return static_cast<double>(count[0]) * static_cast<double>(count[1]) * static_cast<double>(count[2]);
  }
};

/// Found once from the keys of a case; gates are shut unless there are none.
struct Layout {
  explicit Layout(const Parameters& parameters);
  /// \param parameters differ from those of the boundary in nothing that this depends on
  Layout(Parameters parameters, std::shared_ptr<const Boundary> same_boundary);

  Layout with(Parameters other) const { return {std::move(other), boundary}; }
  /// The same for parameters that leave the number of particles of bed.spacing as it is.
  Layout with_same_bed(Parameters other) const {
    Layout layout = with(std::move(other));
    layout.counted = counted;
    return layout;
  }
  /// The case with one bed only: 0 that of [bed], from 1 on those of [[beds]].
  Layout with_bed_alone(std::size_t bed) const;

  Parameters given;
  std::shared_ptr<const Boundary> boundary;
  std::vector<VesselOutlet> vessel_outlets;  ///< the lowest first
  std::optional<Outlet> outlet;
  /// The narrower side of the outlet, or its diameter, m; of a slit that a plane of symmetry cuts, the whole width.
  std::optional<double> outlet_width;
  int copies = 1;                 ///< sectors that make up the whole; without a sector 1
  std::vector<std::size_t> beds;  ///< numbers of those that hold particles
  Lattice lattice;
  double bottom = 0;  ///< of the bed, of several the first, m
  /// How deep grains can lie: the heights of all beds, without those between them; without a bed that of vessel or box
  /// above the bed's bottom, m.
  double depth = 0;
  /// bed_count(), once it is asked for: of a vessel it takes as long as laying the bed. Copies share it.
  struct Counted {
    std::once_flag once;
    double particles = 0;
  };
  std::shared_ptr<Counted> counted = std::make_shared<Counted>();

  const std::optional<Sector>& sector() const { return boundary->domain().sector(); }
  bool has_no_bed() const { return beds.empty(); }  ///< grains come in through an inlet only
};

/// Positions of the particles at the start, bed by bed: those of bed.file, or the positions of the lattice that are
/// visible from bed.inside or the middle of the bed's top, no plate between, and farther than a quarter of the spacing
/// from plates at any angle. Of a sector those that are within it.
std::vector<Vector3> bed_positions(const Layout& layout);

/// Number of those particles, without placing them; exact unless plates stand in a bed of more than a million positions
/// a layer, of which then only some are tried.
double bed_count(const Layout& layout);

// What follows from the keys alone, for the layout and for the check of a case that may have none.

/// Where the lattice of the bed begins and ends along x and y, and its bottom, m: the box, or the walls of the vessel
/// between which the bed lies; where no Layout has found these, the whole vessel if it stands apart from the faces.
struct Extent {
  double low, high;
};
Extent bed_along_x(const Parameters& parameters);
Extent bed_along_y(const Parameters& parameters);
double bed_bottom(const Parameters& parameters);
Lattice lattice_of(const Parameters& parameters);
/// Lowest and highest places of the beds, m, upwards; beds one upon the other, or beside each other, are one.
std::vector<Extent> heights_of_beds(const Parameters& parameters);
/// Layout::depth.
double depth_of_grains(const Parameters& parameters);
Parameters with_bed_alone(const Parameters& parameters, std::size_t bed);
std::vector<std::size_t> beds_of(const Parameters& parameters);
/// Of the plate or the wedge.
std::optional<Outlet> slit_of(const Parameters& parameters);
std::optional<double> outlet_width_of(const Parameters& parameters);
/// The sector that the case computes, about the upright axis through the middle of the box; none: the whole box.
std::optional<Sector> sector_of(const Parameters& parameters);
/// How far a wall from face to face is from others at least, to be a layer of the domain, m.
double min_distance_of_layers(const Parameters& parameters);

/// The same with the height of each bed as its mass needs it: a whole number of spacings, or as the particles of
/// bed.file have it. Unchanged without both, and where lengths are missing or the vessel does not hold that mass
/// (check() says so).
Layout with_level(const Layout& layout);

/// Particles of bed.mass, to the nearest. \pre bed.mass is given, no [[beds]]
double count_of_mass(const Parameters& parameters);

/// What is wrong with bed.mass, if anything. \param layout with_level(), no [[beds]]
std::vector<Problem> check_mass(const Layout& layout);

}  // namespace talus::continuum
