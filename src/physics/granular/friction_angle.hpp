// SPDX-License-Identifier: Apache-2.0
/// What a friction M, the ratio of shear stress to pressure in steady shear of a law whose section is a circle,
/// J_2^(1/2) = M p (critical_state.hpp, drucker_prager.hpp), is as an angle of friction. There is one for each test:
///
///     shear plane           tan phi = M                              shear testers, an endless slope
///     plane strain          sin phi = M                              radius over centre of Mohr's circle
///     triaxial compression  sin phi = 3 3^(1/2) M/(6 + 3^(1/2) M)    the two smaller principal stresses are equal
///
/// In shear at constant volume the deviator lies along the rate of deformation. In plane flow the principal stress
/// across the plane is then the mean of the other two, which is p: Mohr's circle has the centre p and the radius M p,
/// and the planes of simple shear, at 45 degrees to the principal axes, carry the stress p and the shear stress M p. In
/// triaxial compression (sigma_1 - sigma_3)/3^(1/2) = M (sigma_1 + 2 sigma_3)/3. A Mohr-Coulomb material has the same
/// angle in the last two. Source: Drucker & Prager, Q. Appl. Math. 10, 157 (1952), plane flow without dilatancy, and
/// triaxial compression as in Chen & Mizuno, Nonlinear Analysis in Soil Mechanics (Elsevier, 1990). Range: M from 0 to
/// 1 in plane strain, to 3^(1/2) in triaxial compression, where sigma_3 is 0.
#pragma once

#include <cmath>
#include <numbers>

namespace talus::granular {

enum class FrictionTest { shear_plane, plane_strain, triaxial_compression };

/// The angle that a test of grains of friction M gives, rad; nan beyond the range.
inline double angle_of_friction(FrictionTest test, double friction) {
  if (test == FrictionTest::shear_plane) return std::atan(friction);
  if (test == FrictionTest::plane_strain) return std::asin(friction);
  const double third = std::numbers::sqrt3 * friction;
  return std::asin(3 * third / (6 + third));
}

}  // namespace talus::granular
