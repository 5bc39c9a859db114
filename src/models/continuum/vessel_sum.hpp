// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel add to the sums over a particle's neighbours.
///
/// Across the wall. Beyond a wall the field around the particle is taken to go on: the stress linearly, its shear along
/// the wall turned over as in a mirror; the velocity along the wall linearly too, and that across it linearly through 0
/// at the wall. The density is the particle's. The wall pushes along its normal only: friction is Coulomb's
/// (walls.hpp).
///
/// Along the wall. A particle beside a wall has neighbours on one side only; what lacks is the force along the wall of
/// the neighbours' images in it. At the distances a and b of two particles from a plane, each is at the distance
/// (r^2 + 4 a b)^(1/2) from the other's image, and the forces along the wall are equal and opposite: the wall, which is
/// smooth, has no part in them. Where a wall covers a part of its plane only, at a rim or a corner, the images count by
/// the mean of the shares that both particles see.
#pragma once

#include "base/tensor.hpp"
#include "base/vector.hpp"
#include "models/continuum/pair_sweep/kernel.hpp"
#include "models/continuum/vessel_walls.hpp"
#include "numerics/sph/velocity_gradient.hpp"

namespace talus::continuum {

/// The force of a smooth part of a wall on a particle.
struct WallForce {
  std::uint32_t patch = 0;
  Vector3 normal;        ///< unit, towards the particle
  Vector3 acceleration;  ///< m/s^2
};
struct WallForces {
  std::array<WallForce, most_near_walls> of;
  std::size_t count = 0;

  std::span<const WallForce> all() const { return std::span(of).first(count); }
};

/// Adds the walls to the sums of the velocity's gradient. \param velocity of the particle, m/s
/// \returns what they add to the rate of the density, over the density, 1/s
double add_walls(const NearWalls& met, const Vector3& velocity, sph::GradientSums<>& sums);

/// How a particle stands at a part of a wall.
struct SeatAtWall {
  Vector3 normal;
  double distance = 0, share = 0;  ///< as NearWall; a share of 0: it does not
};

/// The acceleration of a particle along a part of a wall by its neighbours' images there, m/s^2.
/// \param seat (record, part) -> SeatAtWall
template <class Seat>
Vector3 force_of_images(const NearWall& wall, const Records& records, std::size_t self, const Neighbours& neighbours,
                        double mass, const Seat& seat);

/// The forces of the walls on a particle, in the order of `met`. \param records, neighbours those of the sweep
WallForces forces_of_walls(const NearWalls& met, const Records& records, std::size_t self, const Neighbours& neighbours,
                           const PairConstants& constants, double sound_speed);

/// The share of one neighbour. \param other number of its record \returns m/s^2
Vector3 force_of_image(const NearWall& wall, const SeatAtWall& its, const Records& records, std::size_t self,
                       std::size_t other, double mass);

template <class Seat>
Vector3 force_of_images(const NearWall& wall, const Records& records, std::size_t self, const Neighbours& neighbours,
                        double mass, const Seat& seat) {
  Vector3 sum;
  const MotionRecord& own = records.motion[self];
  const std::uint32_t end = neighbours.group[neighbours.groups - 1].end;
  for (std::uint32_t n = 0; n < end; ++n) {
    const MotionRecord& other = records.motion[neighbours.record[n]];
    const double h = own.half_length + other.half_length;
    double square = 0;
    for (int axis = 0; axis < 3; ++axis)
      square += (other.position[axis] - own.position[axis]) * (other.position[axis] - own.position[axis]);
    if (!(square < 4 * h * h)) continue;
    if (const SeatAtWall its = seat(neighbours.record[n], wall.part); its.share > 0)
      sum += force_of_image(wall, its, records, self, neighbours.record[n], mass);
  }
  return sum;
}

}  // namespace talus::continuum
