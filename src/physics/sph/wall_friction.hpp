// SPDX-License-Identifier: Apache-2.0
/// Friction of the grains at a wall: what is left of a particle's velocity along the wall after a step.
#pragma once

#include <cmath>

#include "base/vector.hpp"

namespace talus::sph {

/// Coulomb: the wall takes at most mu times the normal impulse from the tangential momentum, and stops the particle if
/// that is enough. A choice; Yuu & Umekage 2011 print mu = 0.3 for their rule below. \param tangential velocity along
/// the wall, m/s; \param normal_push the wall's normal force over the particle's mass, times the step, m/s, counted
/// where it pushes; \param coefficient mu
inline Vector3 coulomb_friction(const Vector3& tangential, double normal_push, double coefficient) {
  const double speed = norm(tangential);
  const double loss = coefficient * normal_push;
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

}  // namespace talus::sph
