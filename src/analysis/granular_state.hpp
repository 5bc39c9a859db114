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

/// The same with the largest |du_i/dx_j + du_j/dx_i|, i != j, in place of the column shear_rate.
/// \param gradients of each particle, 1/s
std::vector<double> inertial_numbers_of_shear(const Snapshot& snapshot, std::span<const Tensor3<>> gradients,
                                              double diameter, double grain_density);

/// The particles that bear a pressure: those that touch nothing are in no regime.
std::vector<bool> bearing_particles(std::span<const double> inertial);

/// Share of the particles taken whose inertial number is below 1e-2; nan if there are none.
double inertial_share(std::span<const double> inertial, const std::vector<bool>& taken);

/// The particles with packing above 0.5, below which no stress acts.
std::vector<bool> dense_particles(const Snapshot& snapshot);

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
  double shear_max = 0, normal_max = 0;                ///< largest |du_i/dx_j| with i != j, with i = j
  double shear_percentile = 0, normal_percentile = 0;  ///< 99.9th percentile over the particles of each one's largest
};
/// \param gradients, packing of each particle; nan if no particle is that dense
GradientSizes velocity_gradient_sizes(std::span<const Tensor3<>> gradients, std::span<const double> packing,
                                      double diameter, double gravity);

/// The same sizes, of a field of velocities that are means over cubic cells: central differences of the velocities at
/// the cells' centres, x and z, over the cells of the plane y = `depth`/2 between two heights whose packing and whose
/// neighbours' is above 0.5; the percentiles over those cells. \param cell edge, m \param width, depth of the box, m
GradientSizes cell_gradient_sizes(const ParticleField& field, std::span<const Vector3> velocity, double cell,
                                  double width, double depth, double bottom, double top, double diameter,
                                  double gravity);

/// Mean over the particles taken of |density/(packing rho_p) - 1|: how far the density by continuity is from the
/// kernel's.
double density_drift(std::span<const double> density, std::span<const double> packing, double grain_density,
                     const std::vector<bool>& taken);

/// Quantile of the values of the particles taken; nan if there are none.
double quantile_of(std::span<const double> values, const std::vector<bool>& taken, double probability);

}  // namespace talus
