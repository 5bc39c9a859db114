// SPDX-License-Identifier: Apache-2.0
/// The readings of the constitutive laws that a case chooses among (law_options.hpp has their names and texts).
#pragma once

#include "base/tensor.hpp"

namespace talus::granular {

/// What the volumetric strain is measured by.
enum class Volume {
  density,  ///< ln(rho_b/rho_ref)/3: tied to the packing, cannot drift from it
  contact,  ///< ln(rho_b/rho_touch)/3, from the density at which the grains last touched (contact_memory.hpp)
  strain    ///< the trace of the strain since the last reset, as in the paper
};

/// What the strain of the printed components follows from.
enum class Strain {
  rate,          ///< de/dt = -D - e L - L^T e (almansi_strain.hpp)
  displacements  ///< Eqs 9-12 from x - X, with X the place at the last reset: the paper's own route
};

/// Which stresses fall along the initial stiffness times k_u when the strain falls, and rise again along the same line
/// to the yield point; the others go back along the loading curve.
enum class Unloading { none, pressure, shear, all };

/// What is forgotten at the end of an unloading process: nothing, the deviator of the strain, or all of it (the paper
/// sets X_i := x_i).
enum class Reset { never, deviator, strain };

/// The strain whose fall is an unloading process. The paper: "normal strain component in the main direction that is
/// vertical".
enum class MainStrain { x, y, z, volume };

/// How shear strains enter the normal stresses of Eqs 1-3.
enum class ShearSum {
  absolute,   ///< |e_xy| + |e_xz|: keeps the mirror symmetry
  with_signs  ///< e_xy + e_xz, as printed
};

/// Options that both forms of the law `yuu-umekage` share.
struct YuuUmekageOptions {
  double scale = 9.80;             ///< alpha, stress of the real field over that of the fits' (130 Pa at the bottom)
  double grain_density = 2500;     ///< rho_p, kg/m^3
  double reference_packing = 0.6;  ///< rho_ref/rho_p, at which the grains just touch
  Strain strain = Strain::rate;    ///< printed components only
  Volume volume = Volume::density;
  double compaction = 3;  ///< k, per shear strain, by which shear makes grains forget that they came apart
  Unloading unloading = Unloading::all;
  double unloading_stiffness = 1.5;  ///< k_u
  Reset reset = Reset::never;
  MainStrain main_strain = MainStrain::z;
  double smoothing_time = 2e-4;             ///< s, over which the rate of the main strain is averaged
  double close_packing = 0.64;              ///< beyond which the pressure rises along its initial stiffness again
  double largest_deviator = 0.014;          ///< |e_dev| beyond which the deviator no longer grows
  ShearSum shear_sum = ShearSum::absolute;  ///< printed components only
  double gate_packing = 0.5;                ///< packing below which contacts are lost
  int gate_power = 96;                      ///< of the factor by which stress then vanishes
};

/// The component of a strain, a rate of strain or a stress along the main direction; a third of the trace for the
/// volume.
template <class Number>
Number main_strain(MainStrain main, const SymmetricTensor3<Number>& strain) {
  return main == MainStrain::x   ? strain.xx
         : main == MainStrain::y ? strain.yy
         : main == MainStrain::z ? strain.zz
                                 : (1.0 / 3.0) * trace(strain);
}

/// The rate of the main strain, averaged over the past: r' = (-D_main - r)/T, implicit in time.
/// \param old_rate 1/s; \param smoothing_time T, s, >= 0
template <class Number>
Number smoothed_main_rate(const Number& old_rate, MainStrain main, const Tensor3<Number>& velocity_gradient,
                          double time_step, double smoothing_time) {
  const Number rate = -1.0 * main_strain(main, symmetric_part(velocity_gradient));
  return old_rate + (time_step / (time_step + smoothing_time)) * (rate - old_rate);
}

}  // namespace talus::granular
