// SPDX-License-Identifier: Apache-2.0
/// The mechanical state of grains as a continuum: inertial number, ratio of stresses, gradients of velocity, shares of
/// packing. One entry per particle in every column; stresses in Pa, compression positive.
#pragma once

#include <span>
#include <vector>

#include "analysis/particle_field.hpp"
#include "base/vector.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// I = shear rate D (rho_p/p)^(1/2); infinite where the pressure is not above 0.
/// Source: da Cruz et al., Phys. Rev. E 72, 021309 (2005), as cited by Yuu & Umekage 2011, section 2.1.
/// \param shear_rate (2 D'_ij D'_ij)^(1/2) of the deviatoric rate of deformation, 1/s; \param pressure mean normal
/// stress, Pa; \param diameter m; \param grain_density kg/m^3
double inertial_number(double shear_rate, double pressure, double diameter, double grain_density);

/// Inertial number of every particle, from the columns shear_rate, stress_xx, stress_yy, stress_zz.
std::vector<double> inertial_numbers(const Snapshot& snapshot, double diameter, double grain_density);

/// Share of the particles taken whose inertial number is below 1e-2; nan if there are none.
double inertial_share(std::span<const double> inertial, const std::vector<bool>& taken, const MassRatios& weight = {});

/// Which particles count as quasi-static grains.
struct QuasistaticRule {
  double packing = 0.55;          ///< above
  double inertial_number = 1e-3;  ///< below
  double stress_zz = 50;          ///< above, Pa
};
std::vector<bool> quasistatic_particles(const Snapshot& snapshot, std::span<const double> inertial,
                                        const QuasistaticRule& rule = {});

/// Horizontal over vertical stress, sum of stress_xx over sum of stress_zz of the particles taken: a mean weighted with
/// the vertical stress. nan if there are none.
double stress_ratio(const Snapshot& snapshot, const std::vector<bool>& taken);

/// Sizes of the components of the velocity's gradient over the particles with packing above 0.5, times (D/g)^(1/2).
struct GradientSizes {
  double shear_max = 0, normal_max = 0;  ///< largest |du_i/dx_j| with i != j, with i = j
};
/// \param gradients, packing of each particle; nan if no particle is that dense
GradientSizes velocity_gradient_sizes(std::span<const Tensor3<>> gradients, std::span<const double> packing,
                                      double diameter, double gravity);

/// Mean over the particles taken of |density/(packing rho_p) - 1|: how far the density by continuity is from the
/// kernel's.
double density_drift(std::span<const double> density, std::span<const double> packing, double grain_density,
                     const std::vector<bool>& taken);

/// Quantile of the values of the particles taken; nan if there are none.
double quantile_of(std::span<const double> values, const std::vector<bool>& taken, double probability);

}  // namespace talus
