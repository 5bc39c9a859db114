// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "physics/granular/yuu_umekage_isotropic.hpp"
#include "physics/granular/yuu_umekage_printed.hpp"

namespace talus::granular {

namespace {

/// The stiffest point of a loading curve, from which the speed of sound follows: largest slope of a curve that is
/// smooth between its joints, from 0 to the last; jumps at joints do not count. \param curve strain -> stress, Pa;
/// \param joints any order, > 0
template <class Curve>
double max_slope(Curve&& curve, std::vector<double> joints) {
  std::sort(joints.begin(), joints.end());
  constexpr int samples = 256;
  double begin = 0, steepest = 0;
  for (const double end : joints) {
    const double step = (end - begin) / samples;
    for (int k = 0; k < samples; ++k) {
      const double e = begin + (k + 0.5) * step, d = 1e-3 * step;
      steepest = std::max(steepest, (curve(e + d) - curve(e - d)) / (2 * d));
    }
    begin = end;
  }
  return steepest;
}

}  // namespace

YuuUmekageIsotropic::YuuUmekageIsotropic(const Parameters& parameters, double grain_density)
    : parameters_(parameters),
      memory_(parameters.contact),
      pressure_(pressure_table(parameters.fits.functions())),
      shear_(shear_table(parameters.fits.functions())),
      close_volume_(volumetric_strain(parameters.close_packing, parameters.contact.reference_packing)),
      initial_pressure_(parameters.fits.functions().a1.piece[0].c0 + 2 * parameters.fits.functions().a2.piece[0].c0),
      line_ratio_(parameters.rule.unloading_stiffness * parameters.fits.functions().a4.piece[0].c0),
      inverse_line_ratio_(1 / line_ratio_),
      grain_density_(grain_density) {
  if (!(parameters_.fits.max_deviator <= max_fitted_strain))
    throw std::invalid_argument("the largest deviator lies beyond the range of the fits");
  // Uniaxial strain e: e_v = e/3, e_dev,zz = 2e/3, |e_dev| = sqrt(2/3) e.
  const double deviator = std::sqrt(2.0 / 3.0);
  std::vector<double> joints;
  for (int k = 0; k < pressure_.pieces(); ++k) joints.push_back(sqrt3 * pressure_.end(k));
  for (int k = 0; k < shear_.pieces(); ++k) joints.push_back(shear_.end(k) / deviator);
  joints.push_back(parameters_.fits.max_deviator / deviator);
  steepest_ = parameters_.fits.scale * max_slope(
                                           [&](double e) {
                                             const double held = std::min(deviator * e, parameters_.fits.max_deviator);
                                             return pressure_(e / sqrt3) / sqrt3 * (1 + deviator * shear_(held) * held);
                                           },
                                           joints);
  // Beyond close packing the stress ratio can be the largest one, and the pressure of the fits still rises a little.
  const double most = parameters_.fits.max_deviator;
  const double close = (initial_pressure_ + pressure_(max_fitted_strain) / max_fitted_strain) / 3;
  steepest_ = std::max(steepest_, parameters_.fits.scale * close * (1 + deviator * shear_(most) * most));
  if (parameters_.unloading != Unloading::none) steepest_ *= parameters_.rule.unloading_stiffness;
}

double YuuUmekageIsotropic::sound_speed(double density) const {
  return std::sqrt(steepest_ * density_factor(density / grain_density_) / density);
}

std::vector<Problem> YuuUmekageIsotropic::check(const Parameters& parameters) {
  return check_reset(parameters.rule.reset, parameters.contact.volume);
}

YuuUmekagePrinted::YuuUmekagePrinted(const Parameters& parameters, double grain_density)
    : parameters_(parameters),
      memory_(parameters.contact),
      table_(component_table(parameters.fits.functions())),
      max_ratio_(0),
      grain_density_(grain_density),
      inverse_grain_density_(1 / grain_density) {
  const FittedFunctions& functions = parameters.fits.functions();
  const FittedFunction* const each[] = {&functions.a1, &functions.a2, &functions.a3, &functions.a4};
  for (int k = 0; k < 4; ++k) initial_[k] = each[k]->piece[0].c0;
  const auto value = [&](int function, double a) {
    double A[4];
    table_.evaluate(a, A);
    return A[function];
  };
  std::vector<double> joints;
  for (int k = 0; k < table_.pieces(); ++k) joints.push_back(table_.end(k));
  for (int k = 1; k <= 3500; ++k) {
    const double a = max_fitted_strain * k / 3500;
    if (a <= parameters_.fits.max_deviator) max_ratio_ = std::max(max_ratio_, value(3, a) * a);
  }
  steepest_ = parameters_.fits.scale * max_slope([&](double e) { return value(0, e) * e; }, joints);
  if (parameters_.unloading != PrintedUnloading::none) steepest_ *= parameters_.rule.unloading_stiffness;
}

double YuuUmekagePrinted::sound_speed(double density) const {
  return std::sqrt(steepest_ * density_factor(density / grain_density_) / density);
}

std::vector<Problem> YuuUmekagePrinted::check(const Parameters& parameters) {
  return check_reset(parameters.rule.reset, parameters.contact.volume);
}

}  // namespace talus::granular
