// SPDX-License-Identifier: Apache-2.0
/// What a wall does to a particle in a step: unilateral contact along its normal, and friction along it.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector.hpp"

namespace talus::sph {

/// Coulomb: the wall takes at most mu times the normal impulse from the tangential momentum, and stops the particle if
/// that is enough. A choice; Yuu & Umekage 2011 print mu = 0.3 for their rule below. \param tangential velocity along
/// the wall, m/s; \param normal_push the wall's normal impulse over the particle's mass, m/s, counted where it pushes;
/// \param coefficient mu \param adhesion the same impulse of a stress that needs no push, m/s
inline Vector3 coulomb_friction(const Vector3& tangential, double normal_push, double coefficient,
                                double adhesion = 0) {
  const double speed = norm(tangential);
  const double loss = coefficient * normal_push + adhesion;
  if (!(loss > 0)) return tangential;
  return speed > loss ? (1 - loss / speed) * tangential : Vector3{};
}

/// The printed rule, scaled to the step: where the ratio of shear to normal stress at the wall is less than the
/// coefficient, the velocity along it shrinks by 0.95 each 2 microseconds; else the particle slides freely.
/// Source: Yuu & Umekage 2011, section 3 ("multiplying by 0.95 for each time step", 2.0e-6 s).
/// deviates: printed for their step only; the power makes the rate of decay, 2.6e4 /s, independent of it.
/// \param shear, normal size of the stresses on the wall's plane, Pa; \param time_step s
inline Vector3 printed_friction(const Vector3& tangential, double shear, double normal, double coefficient,
                                double time_step) {
  return shear < coefficient * normal ? std::pow(0.95, time_step / 2.0e-6) * tangential : tangential;
}

/// The distance at which a wall holds a particle that nothing else holds, in spacings of a dense bed: a little less
/// than the half at which a lattice begins, so that the stress of a bed acts alone where there is one.
inline constexpr double contact_distance = 0.47;

/// A wall as a particle near it meets it in a step.
struct WallContact {
  Vector3 normal;         ///< unit, towards the particle
  Vector3 wall_velocity;  ///< along the wall, m/s
  double stress_push;     ///< normal impulse over mass that the stress of the step has given already, m/s
  double coefficient;     ///< mu
  double adhesion = 0;    ///< impulse over mass of the wall's adhesion, along it, m/s
  double parting = 0;     ///< of the step's pull what the wall cannot hold, m/s
};

/// Of a step's pull, the excess over what a wall holds: its yield locus, |tau| <= mu sigma + adhesion, ends at a
/// tension of adhesion/mu. All in m/s, as impulses over mass.
inline double parting(double stress_push, double adhesion, double coefficient) {
  return std::max(0.0, -stress_push - (coefficient > 0 ? adhesion / coefficient : adhesion));
}

/// Signorini's condition on the velocity: what a wall adds to the velocity along its normal, m/s, so that the particle
/// comes no nearer within the step than its contact distance. The approach in excess is lost (restitution 0). A
/// particle that is nearer already is held where it is: pushed out, the first layer of a bed that a lattice laid too
/// near to a wall would press on the rest for ever. So a contact takes energy only.
/// Source: Moreau, in Nonsmooth Mechanics and Applications (1988), 1; Jean, Comput. Methods Appl. Mech. Eng. 177, 235
/// (1999).
/// \param along_normal velocity towards the particle's side, m/s; \param gap of the particle from its contact distance,
/// m, below 0 where it is nearer; \param step over which it will move with that velocity, s
inline double contact_push(double along_normal, double gap, double step) {
  return std::max(0.0, std::min(0.0, -gap / step) - along_normal);
}

/// The velocity of a particle after contact, without a pull that the wall does not hold, and Coulomb's friction with
/// all that contact and stress push together, m/s. \param velocity of the particle, m/s; \param push contact_push() of
/// it, m/s
inline Vector3 after_contact(const Vector3& velocity, const WallContact& wall, double push) {
  const double along_normal = dot(velocity, wall.normal);
  const Vector3 tangential = velocity - along_normal * wall.normal - wall.wall_velocity;
  const double pushed = push + wall.parting;
  return (along_normal + pushed) * wall.normal + wall.wall_velocity +
         coulomb_friction(tangential, wall.stress_push + pushed, wall.coefficient, wall.adhesion);
}

}  // namespace talus::sph
