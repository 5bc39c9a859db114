// SPDX-License-Identifier: Apache-2.0
/// Particles of several sizes: those of bed.spacing where the flow is to be resolved, at outlets and in a box, and
/// coarser ones farther away, of twice the spacing at each level. A level begins at twice the distance of the one
/// before, so that an angle of the flow towards an outlet holds about as many particles at any distance.
///
/// About the axis of a sector a particle is a ring with its copies, each with an arc of r times the sector's angle.
/// Where the arc is shorter than bed.spacing, the ring of a whole particle would be wider or higher than that: there
/// are halves, quarters and eighths of a particle, levels -1 to -3, with the smoothing length of bed.spacing. Where a
/// coarser level may be, the arc may be half as long: nothing there decides what passes an outlet.
///
/// The mass of a particle is a whole number of eighths of that of a particle of bed.spacing: splitting and merging
/// (splitting.hpp) move whole parts, and lose none.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "base/vector.hpp"
#include "numerics/geometry/sector.hpp"

namespace talus::continuum {

struct Layout;
struct Parameters;

struct LevelParameters {
  std::int64_t count = 0;          ///< of levels coarser than bed.spacing
  std::optional<double> distance;  ///< of the first of them, m; left out: 1 + count / 2 widths of the outlet
  std::optional<std::array<double, 3>> low, high;
};

template <class Visit, class L>
void for_each_parameter_of_levels(Visit&& visit, L& levels) {
  visit(Parameter{"levels.count", dimension::none, between(0, 3),
                  "how many sizes of particles there are besides that of bed.spacing, each of twice the spacing and "
                  "eight times the mass of the one before: particles split on their way to the outlets and merge where "
                  "they leave them"},
        levels.count);
  auto coarser = only_if({"levels.count", "is 0", "above 0", levels.count > 0}, visit);
  coarser(Parameter{"levels.distance", dimension::length, above(0),
                    "distance from the outlets and from the box of levels.low and levels.high within which particles "
                    "have bed.spacing; those of the next size lie up to twice this distance, and so on; left out: "
                    "1 + levels.count / 2 widths of the outlet"},
          levels.distance);
  coarser(Parameter{"levels.low",
                    dimension::length,
                    {},
                    "lower corner of a box in which particles have bed.spacing, x, y and z; left out: none"},
          levels.low);
  coarser(Parameter{"levels.high", dimension::length, {}, "its upper corner"}, levels.high);
}

/// integration.skin of cases with levels that leave it out: grains of bed.spacing that fall below an outlet would have
/// all lists built every few steps.
constexpr double skin_of_levels = 2;

constexpr int lightest_level = -3;  // an eighth, parts_of_mass

/// Whether particles of a case split about the axis of its sector.
bool splits_at_axis(const Parameters& parameters);
/// That, or levels.
bool has_several_masses(const Parameters& parameters);

/// The level of a particle by its mass, to the nearest. \param mass_ratio to that of a particle of bed.spacing, at
/// least an eighth
inline int level_of(double mass_ratio) {
  int level = 0;
  for (double bound = std::sqrt(8.0); mass_ratio > bound; bound *= 8) ++level;
  for (double bound = std::sqrt(0.5); level > lightest_level && mass_ratio < bound; bound *= 0.5) --level;
  return level;
}

/// The mass ratio of a particle of a level, as it is laid.
inline double mass_ratio_of(int level) {
  return std::exp2(level < 0 ? level : 3 * level);
}

/// Which level is wanted where.
class Levels {
 public:
  explicit Levels(const Layout& layout);

  int count() const { return count_; }  ///< of levels coarser than bed.spacing
  int lightest() const { return sector_ ? lightest_level : 0; }
  /// The level that a particle at x is to have. \param slack factor of the distances at which levels begin
  int wanted(const Vector3& x, double slack = 1) const;
  /// Factor of those distances beyond which particles merge: what has split just now does not merge at once.
  static constexpr double slack_of_merging = 1.15;
  /// A spacing over bed.spacing, at least half of that of the level wanted, which grows with the distance without a
  /// jump: 2, 4, 8 where levels begin.
  double smooth_spacing(const Vector3& x) const;
  /// The number of the cell in which particles of a level merge: of twice its spacing, of bed.spacing below level 0, on
  /// the lattice of the bed, about the axis of a sector one of a ring.
  std::array<std::int64_t, 3> cell_of(const Vector3& x, int level) const;
  /// Its middle, m.
  Vector3 middle_of(const std::array<std::int64_t, 3>& cell, int level) const;

 private:
  double square_of_distance(const Vector3& x) const;
  Vector3 size_of_cell(int level) const;
  double places_in_ring(std::int64_t ring) const;

  struct Region {
    Vector3 low, high;  ///< m
  };
  int count_;
  double distance_ = 0;  // m
  std::vector<Region> regions_;
  std::optional<Sector> sector_;
  Vector3 corner_, spacing_;  // of the lattice, of a sector along the radius, any and z, m
};

/// How many particles there are at the start for each of those of bed.spacing: the mean over the bed of one over the
/// mass ratio that is wanted.
double share_of_particles(const Layout& layout);

/// Shares of the particles of the start that are left where shares of the mass, 0 to 1, have left, what is highest
/// first: finer ones near an outlet stay the longest.
std::vector<double> shares_left(const Layout& layout, std::span<const double> shares_of_mass);

/// What levels of a case cannot be, by its keys alone, and in its layout if that is sound.
std::vector<Problem> check_levels(const Parameters& parameters);
std::vector<Problem> check_levels(const Layout& layout);

}  // namespace talus::continuum
