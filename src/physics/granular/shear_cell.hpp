// SPDX-License-Identifier: Apache-2.0
/// What a powder laboratory measures, on one material point of a law: shear to steady state under a load, failure under
/// lower loads, and failure without or with little lateral load; and how the trade evaluates it.
///
/// Shear tester (Jenike, Schulze): a layer between rough plates, sheared along x, loaded along z, its sides held. *Pre-
/// shear* to steady state under sigma_pre; the shear stress taken off, the stress lowered, the same all around; *shear
/// to failure*, whose largest shear stress is a point of the yield locus. Evaluation, ASTM D6773: the straight line
/// through these points, tau = c + sigma tan(phi), gives the unconfined yield strength by the Mohr circle through the
/// origin that touches it,
///     f_c = 2 c cos(phi)/(1 - sin(phi)),
/// and the consolidation stress sigma_1 by the larger circle that touches it and passes through the point of pre-shear,
/// whose centre lies at
///     m = [A - (A^2 sin^2(phi) - tau_pre^2 cos^2(phi))^(1/2)]/cos^2(phi) - c/tan(phi),  A = sigma_pre + c/tan(phi).
/// The line from the origin that touches that circle has the effective angle; ff_c = sigma_1/f_c.
/// On a wall: the same sample on a coupon of the wall in place of the lower plate slides where its shear stress reaches
/// mu_w sigma + adhesion, the wall yield locus; on a rougher wall it fails itself.
/// Uniaxial and triaxial tests: compressed along z under a constant lateral stress. Oedometer: loaded along z, its
/// sides held. Sources: Jenike, Storage and Flow of Solids, Bulletin 123 (Utah, 1964); Schulze, Powders and Bulk Solids
/// (Springer, 2008), ch. 3; ASTM D6773-16. deviates: the trade takes the shear plane of the tester for a plane of
/// failure. A law whose principal directions are those of the shear has tan(phi) = M there and sin(phi) = M in plane
/// strain, so that f_c by the line is less than f_c of a compressed sample; both are given.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "physics/granular/material_path.hpp"

namespace talus::granular {

/// A wall that grains slide along: its friction coefficient, and the shear stress that it bears besides, Pa.
struct CellWall {
  double coefficient = 0, adhesion = 0;
};

/// How the tests are run.
struct ShearCellOptions {
  double density = 1500;        ///< kg/m^3, of the sample as it is laid, free of stress
  double rate = 3e-3;           ///< 1/s, shear rate; axial rate of compression
  double max_increment = 1e-4;  ///< of the strain within a step
  double steady_strain = 4;     ///< shear strain of pre-shear
  double failure_strain = 0.1;  ///< shear or axial strain within which a sample fails
  std::optional<CellWall> wall = {};
};

/// A point of a yield locus, Pa.
struct YieldPoint {
  double normal = 0, shear = 0;
};

/// A straight yield locus, and the stresses that the trade derives from it and from pre-shear, Pa, rad.
struct YieldLocus {
  double cohesion = 0, angle = 0;
  double major = 0;            ///< sigma_1
  double strength = 0;         ///< f_c
  double effective_angle = 0;  ///< of the line from the origin that touches the circle of sigma_1

  double flow_factor() const { return major / strength; }  ///< ff_c; infinite without strength
};

/// \param points at least two different loads \throws std::invalid_argument if there are fewer, or no friction
YieldLocus evaluated(const YieldPoint& pre_shear, std::span<const YieldPoint> points);

/// A sample compressed along z under a lateral stress: the stresses at its peak, Pa.
struct Compression {
  double lateral = 0, axial = 0;
};

/// All that is measured after pre-shear under one load.
struct ShearTest {
  YieldPoint pre_shear = {};
  double density = 0;                    ///< kg/m^3, in pre-shear
  std::vector<YieldPoint> points = {};   ///< one for each fraction of the load
  std::vector<YieldPoint> on_wall = {};  ///< the same on the wall, and one under the whole load; empty without a wall
  YieldLocus locus = {};
  double strength_in_plane_strain = 0;     ///< f_c of a compressed sample that cannot widen along y, Pa; nan: no peak
  double strength_of_cylinder = 0;         ///< f_c of one that widens along x and y, Pa; nan: no peak
  Compression oedometer = {};              ///< a new sample that cannot widen, under the load: its stresses
  double density_in_oedometer = 0;         ///< kg/m^3
  std::vector<Compression> triaxial = {};  ///< of cylinders under lateral stresses of the same fractions of the load
};

/// \param load sigma_pre, Pa, > 0 \param fractions of it, each in (0, 1), at least two
/// \throws NumericalError as follow_path, std::invalid_argument as evaluated
ShearTest shear_test(const AnyLaw& law, double load, std::span<const double> fractions,
                     const ShearCellOptions& options = {});

}  // namespace talus::granular
