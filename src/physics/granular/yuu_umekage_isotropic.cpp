// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/yuu_umekage_isotropic.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/granular/uniaxial_slope.hpp"

namespace talus::granular {

YuuUmekageIsotropic::YuuUmekageIsotropic(const YuuUmekageOptions& options, const FittedFunctions& functions)
    : options_(options),
      memory_(options.volume, options.reference_packing, options.gate_packing, options.compaction),
      pressure_(pressure_table(functions)),
      shear_(shear_table(functions)),
      close_volume_(volumetric_strain(options.close_packing, options.reference_packing)),
      initial_pressure_(functions.a1.piece[0].c0 + 2 * functions.a2.piece[0].c0),
      line_ratio_(options.unloading_stiffness * functions.a4.piece[0].c0),
      inverse_line_ratio_(1 / line_ratio_),
      inverse_grain_density_(1 / options.grain_density) {
  if (!(options_.largest_deviator <= largest_fitted_strain))
    throw std::invalid_argument("the largest deviator lies beyond the range of the fits");
  // Uniaxial strain e: e_v = e/3, e_dev,zz = 2e/3, |e_dev| = sqrt(2/3) e.
  const double deviator = std::sqrt(2.0 / 3.0);
  std::vector<double> joints;
  for (int k = 0; k < pressure_.pieces(); ++k) joints.push_back(sqrt3 * pressure_.end(k));
  for (int k = 0; k < shear_.pieces(); ++k) joints.push_back(shear_.end(k) / deviator);
  joints.push_back(options_.largest_deviator / deviator);
  steepest_ = options_.scale * steepest_slope(
                                   [&](double e) {
                                     const double held = std::min(deviator * e, options_.largest_deviator);
                                     return pressure_(e / sqrt3) / sqrt3 * (1 + deviator * shear_(held) * held);
                                   },
                                   joints);
  // Beyond close packing the stress ratio can be the largest one, and the pressure of the fits still rises a little.
  const double most = options_.largest_deviator;
  const double close = (initial_pressure_ + pressure_(largest_fitted_strain) / largest_fitted_strain) / 3;
  steepest_ = std::max(steepest_, options_.scale * close * (1 + deviator * shear_(most) * most));
  if (options_.unloading != Unloading::none) steepest_ *= options_.unloading_stiffness;
}

double YuuUmekageIsotropic::sound_speed(double density) const {
  return std::sqrt(steepest_ * density_factor(density / options_.grain_density) / density);
}

}  // namespace talus::granular
