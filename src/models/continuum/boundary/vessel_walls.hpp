// SPDX-License-Identifier: Apache-2.0
/// The walls of a vessel as the particles near them meet them: integrals of the kernel over what lies beyond, by smooth
/// part of the surface (physics/sph/wall_integrals.hpp), and the field that is taken to be there.
///
/// With the lists of neighbours the points within reach are found, twice the smoothing length and what the particle may
/// move: of the finest of three sets for the first layer of particles, of coarser ones, as exact from there on, for
/// others (points_of_walls). So are the particles that stand with one at the same part.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "models/continuum/boundary/kernels/kernel.hpp"
#include "models/continuum/boundary/wall_visibility.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/neighbourhood.hpp"
#include "numerics/surface/surface.hpp"
#include "numerics/surface/surface_fields.hpp"

namespace talus::continuum {

/// A smooth part of a wall near a particle.
struct NearWall {
  std::uint32_t patch = 0, part = 0;
  std::uint32_t stand = 0;  ///< number of the particle's stand at this part
  FieldShare fields;        ///< of the part that the particle faced when lists were built: they note the load
  Vector3 normal;           ///< unit, towards the particle; the mean of what the particle sees of it
  double distance = 0;      ///< from it, m
  double share = 0;         ///< that it covers of a plane without end at that distance, 0 to 1
  WallTotals sums;

  Vector3 slope() const { return {sums.slope[0], sums.slope[1], sums.slope[2]}; }
  Vector3 closing() const { return {sums.closing[0], sums.closing[1], sums.closing[2]}; }
  SymmetricTensor3<> moment() const {
    const double* m = sums.moment;
    return {m[0], m[1], m[2], m[3], m[4], m[5]};
  }
};

/// Those that a particle meets at once.
using NearWalls = std::span<const NearWall>;
/// The most of them; of more, those with the least weight are left out.
inline constexpr std::size_t max_near_walls = 4;

/// A set of points of the walls, in spacings.
struct PointsOfWalls {
  double apart;  ///< the side of the square that a point stands for
  double from;   ///< distance of the particles that take it
};
/// Errors are shares of the push of a plane half a spacing away. Of the finest set it is right to 0.6 % from there on,
/// to 3 % from 0.4 spacings on (WallIntegrals.AreThoseOfAPlane), of the others from where they are taken to 0.5 and
/// 0.9 %. A particle takes one set only: sums over evenly spread points are exact far beyond their distance, and a
/// border between two sets would spoil that.
inline constexpr std::size_t sets_of_points = 3;
inline constexpr std::array<PointsOfWalls, sets_of_points> points_of_walls{{{0.4, 0}, {0.57, 0.75}, {0.8, 1.0}}};
/// Particles of the next level take those from the third on, which is the first for twice the spacing, and two more.
inline constexpr std::size_t max_sets_of_points = sets_of_points + 2 * 3;
/// How many sets there are with so many coarser levels, and how far apart the points of one are, in spacings.
constexpr std::size_t sets_for(int levels) {
  return sets_of_points + 2 * static_cast<std::size_t>(levels);
}
constexpr double apart_in(std::size_t set) {
  return set < sets_of_points ? points_of_walls[set].apart : 2 * apart_in(set - 2);
}

class VesselWalls {
 public:
  /// \param surface, fields outlive it; \param spacing of the particles, m; \param set of the sums, of this processor
  /// \param fields of the surface that note loads, null: none \param sector of which the surface has copies
  /// \param levels of particles of twice the spacing, four times, and so on
  VesselWalls(const Surface& surface, double spacing, InstructionSet set, const SurfaceFields* fields = nullptr,
              const std::optional<Sector>& sector = {}, int levels = 0);

  bool is_empty() const { return surface_.is_empty(); }
  const Surface& surface() const { return surface_; }

  /// Finds, for each particle, the points of the walls within reach, and the neighbours at the same parts of walls
  /// (vessel_stands.cpp). \param neighbourhood of the particles, with lists built just now \param margin by which a
  /// particle may move and grow while they hold, m \param mass_ratio of the particles, empty: 1
  void find(ThreadTeam& team, const Neighbourhood& neighbourhood, std::span<const Vector3> position,
            std::span<const double> smoothing_length, std::span<const double> margin,
            std::span<const double> mass_ratio = {});

  /// Takes the sums over those points, of the particles as they are now; open gates left out.
  void meet(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length);
  /// Whether it has since the lists were built.
  bool is_met() const { return is_met_; }

  /// The walls that a particle meets. \pre meet()
  NearWalls of(std::size_t particle) const {
    if (slot_[particle] < 0) return {};
    const auto slot = static_cast<std::size_t>(slot_[particle]);
    return std::span(met_).subspan(first_stand_[slot], met_count_[slot]);
  }

  /// The particles that may meet walls, rising, and the place of one among them; -1: it does not.
  std::span<const std::uint32_t> particles() const { return particles_; }
  std::int32_t place_of(std::size_t particle) const { return slot_[particle]; }

  /// Where a particle at a place in particles() would touch the surface that moves from x to y: come nearer to it than
  /// `within`, m, or pass it. What is found serves the next search for this particle.
  struct Touch {
    std::uint32_t triangle;
    Vector3 place;   ///< of the surface, m
    Vector3 normal;  ///< unit, towards the particle
  };
  std::optional<Touch> touched(std::size_t place, const Vector3& x, const Vector3& y, double within);

  /// The acceleration of a particle along a part of a wall by its neighbours' images there (pairs/wall_sums.hpp),
  /// m/s^2. \param seen the neighbours that count, sorted; null: all of its list \param mass of a particle, kg, 0: of
  /// each that of its record
  Vector3 force_of_images(const NearWall& wall, const Records& records, std::size_t particle,
                          const std::span<const std::uint32_t>* seen, double mass) const;

 private:
  /// A particle at a smooth part of a wall.
  struct Stand {
    std::uint32_t first, count;  ///< of its points in near_, with those that fill up registers
    std::uint32_t patch, part;
    FieldShare fields;
    double distance;  ///< from the plane of the nearest of them at least, m
  };
  struct Found;
  class PointsAround;
  void find_stands(const Neighbourhood& neighbourhood, std::span<const Vector3> position,
                   std::span<const double> smoothing_length, std::span<const double> margin,
                   std::span<const double> mass_ratio, std::size_t chunk, Found& found) const;
  PointsOfPart points_of_part(const Vector3& position, std::span<std::uint32_t> points) const;
  bool add_stands(const Vector3& position, std::span<std::uint32_t> near, Found& found) const;
  Vector3 normal_of(std::uint32_t record) const {
    const float* n = records_[record].normal;
    return {n[0], n[1], n[2]};
  }
  void find_pairs(ThreadTeam& team, const Neighbourhood& neighbourhood, std::span<const Vector3> position,
                  std::span<const double> smoothing_length, std::span<const double> margin);
  void meet(std::size_t slot, const Vector3& position, double smoothing_length);
  double share_of_plane(double weight, double distance_over_h) const;

  const Surface& surface_;
  const SurfaceFields* fields_;
  WallKernels kernels_;
  double spacing_;
  double quantum_ = 0;                  // of the places of the records, m
  std::vector<WallPoint> records_;      // of the points, one set after the other, and one without area
  std::vector<Vector3> places_;         // of the records, m
  std::vector<std::uint32_t> parts_;    // of the records
  std::vector<std::uint32_t> patches_;  // of the parts
  WallVisibility visibility_;           // of the records
  std::size_t sets_;                    // of points
  std::array<std::optional<CellGrid>, max_sets_of_points> grids_;
  std::array<std::uint32_t, max_sets_of_points> first_record_{};
  std::vector<std::uint32_t> near_;         // records near the particles, by stand, padded to whole registers
  std::vector<std::int32_t> slot_;          // of every particle, -1: no wall within reach
  std::vector<std::uint32_t> particles_;    // by slot
  std::vector<std::uint32_t> first_stand_;  // by slot; one more at the end
  std::vector<Stand> stands_;
  std::vector<WallSeat> seats_;  // of the stands, of images of particles that have some, and one of nobody
  struct ImageOfSeat {
    std::uint32_t stand;
    Image image;
  };
  std::vector<ImageOfSeat> images_;
  std::vector<std::uint32_t> first_pair_;  // by stand; a multiple of a register; one more at the end
  std::vector<std::uint32_t> pair_record_, pair_seat_;
  std::vector<NearWall> met_;            // by stand; of a particle those that it meets come first
  std::vector<std::uint8_t> met_count_;  // by slot
  /// What is known of the surface around a place: that none of it is nearer than a distance and, where triangles are
  /// named, that no others lie within the reach of the search.
  struct Clearance {
    static constexpr std::size_t max_triangles = 10;
    Vector3 around;
    double distance = 0;
    std::uint32_t triangles = 0;  // 0: not known
    std::array<std::uint32_t, max_triangles> triangle{};
  };
  std::optional<Surface::Foot> foot_near(Clearance& clear, const Vector3& y, double within) const;
  std::vector<Clearance> clearance_;  // by slot
  bool is_met_ = false;
  std::vector<double> plane_;  // weight of a plane by its distance, in steps of h/64
};

}  // namespace talus::continuum
