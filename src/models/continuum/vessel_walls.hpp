// SPDX-License-Identifier: Apache-2.0
/// The walls of a vessel as the particles near them meet them: integrals of the kernel over what lies beyond, by smooth
/// part of the surface (physics/sph/wall_integrals.hpp), and the field that is taken to be there.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "models/continuum/wall_sweep/kernel.hpp"
#include "numerics/surface/surface.hpp"
#include "numerics/surface/surface_points.hpp"

namespace talus::continuum {

/// A smooth part of a wall near a particle.
struct NearWall {
  std::uint32_t patch = 0, part = 0;
  Vector3 normal;       ///< unit, towards the particle; the mean of what the particle sees of it
  double distance = 0;  ///< from it, m
  double share = 0;     ///< that it covers of a plane without end at that distance, 0 to 1
  WallTotals sums;

  Vector3 slope() const { return {sums.slope[0], sums.slope[1], sums.slope[2]}; }
  Vector3 closing() const { return {sums.closing[0], sums.closing[1], sums.closing[2]}; }
  SymmetricTensor3<> moment() const {
    const double* m = sums.moment;
    return {m[0], m[1], m[2], m[3], m[4], m[5]};
  }
};

/// The most parts that a particle meets at once; of more, those with the least weight are left out.
inline constexpr std::size_t most_near_walls = 4;

struct NearWalls {
  std::array<NearWall, most_near_walls> of;
  std::size_t count = 0;

  std::span<NearWall> all() { return std::span(of).first(count); }
  std::span<const NearWall> all() const { return std::span(of).first(count); }
};

class VesselWalls {
 public:
  /// \param surface outlives it; \param spacing of the particles, m; \param set of the sums, of this processor
  VesselWalls(const Surface& surface, double spacing, InstructionSet set);

  bool is_empty() const { return surface_.is_empty(); }
  const Surface& surface() const { return surface_; }

  /// Finds the points of the walls within reach of each particle: twice its smoothing length and the skin.
  void find(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length, double skin);

  /// Takes the sums over those points, of the particles as they are now; open gates left out.
  void meet(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length);

  /// The walls that a particle meets. \pre meet()
  const NearWalls& of(std::size_t particle) const {
    return slot_[particle] < 0 ? nothing_ : met_[static_cast<std::size_t>(slot_[particle])];
  }

 private:
  void meet(std::size_t particle, const Vector3& position, double smoothing_length, NearWalls& met) const;
  double share_of_plane(double weight, double distance_over_h) const;

  const Surface& surface_;
  SumWalls* sum_;
  std::vector<SurfacePoint> points_;
  std::vector<Vector3> places_;     // of the points
  std::vector<WallPoint> records_;  // of the points, and one without area
  std::vector<std::size_t> first_ = {0};
  std::vector<std::uint32_t> near_;       // points of every particle, by part
  std::vector<std::int32_t> slot_;        // of every particle in met_, -1: no wall within reach
  std::vector<std::uint32_t> particles_;  // that have a slot
  std::vector<NearWalls> met_;
  NearWalls nothing_;
  std::vector<double> plane_;  // weight of a plane by its distance, in steps of h/64
};

}  // namespace talus::continuum
