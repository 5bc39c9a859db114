// SPDX-License-Identifier: Apache-2.0
/// What EN 1991-4 says of a vessel's walls (physics/granular/en1991.hpp), beside what they carry in a run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/hopper.hpp"
#include "app/continuum/silo_shape.hpp"
#include "physics/granular/en1991.hpp"

namespace talus::app {

/// The upright walls that hold a height, as the code sees them.
struct CodeSilo {
  std::string name;      ///< of the walls
  std::size_t part = 0;  ///< the first of them, of the vessel
  granular::en1991::Silo silo;
  granular::en1991::Solid solid;
  bool is_listed = false;      ///< in the code's table; else solid is unknown_solid() of the law's friction
  double friction = 0;         ///< mean, of the walls from here to the bed's top
  double own_friction = 0;     ///< mean, of this wall
  double own_weight = 0;       ///< gamma of the bed, N/m^3
  double top = 0, bottom = 0;  ///< of the bed, and of the walls or a floor within, m
  double eccentricity = 0;     ///< e_o, the farthest outlet's from the axis, m; e_f is 0: beds are laid level

  /// A round silo whose outlet is so far from its axis that the flow channel counts.
  bool has_channel() const;
  double weight(granular::en1991::Limit limit) const;
  granular::en1991::Values values(granular::en1991::Load load, granular::en1991::Limit limit) const;
  /// After filling, of the values for a load. \param height m
  granular::en1991::Stresses filling(granular::en1991::Load load, granular::en1991::Limit limit, double height) const;
};

/// Nothing where no upright walls reach from a place to the bed's top, or where the silo ends above it. \param top of
/// the bed, m
std::optional<CodeSilo> silo_of_code(const SiloShape& shape, double top, const Vector3& place);

/// Characteristic loads on a band, Pa; nan where the code has no formula.
struct CodeLoads {
  double pressure_filling = no_value, shear_filling = no_value;
  double pressure_discharge = no_value, shear_discharge = no_value;
  double pressure_filling_lower = no_value, pressure_discharge_lower = no_value;
  double in_channel = no_value, beside_channel = no_value;  ///< of the channel's radii the extremes
};

/// On upright walls, hoppers under them and level floors between them. \param top of the bed, m \param
/// height of the place, m
CodeLoads code_loads(const SiloShape& shape, const BandOfWall& band, double top, double height);

/// The local load that the code adds, at the depth min(z_o, h_c/2).
struct CodePatch {
  double filling = 0, discharge = 0;  ///< p_pf, p_pe, Pa, upper
  double height = 0, extent = 0;      ///< of its middle, and along the wall, m
};
CodePatch patch_of_code(const CodeSilo& silo);

/// Writes analysis/en1991.csv: of each upright wall that the bed reaches what the code takes, and its patch load;
/// nothing without such walls. \param bare parts that no grain has touched \throws FileError
void write_design_code(const std::filesystem::path& run_folder, const SiloShape& shape, double top,
                       const std::set<std::size_t>& bare = {});

/// The same as key results: class, values and limits, patch load, flow channel. \param run_folder with
/// analysis/en1991.csv, if there is one \throws FileError
std::vector<Answer> answers_of_code(const SiloShape& shape, const std::filesystem::path& run_folder);

}  // namespace talus::app
