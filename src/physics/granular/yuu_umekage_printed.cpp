// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/yuu_umekage_printed.hpp"

#include <algorithm>
#include <cmath>

#include "physics/granular/uniaxial_slope.hpp"

namespace talus::granular {

YuuUmekagePrinted::YuuUmekagePrinted(const Parameters& parameters, double grain_density)
    : parameters_(parameters),
      memory_(parameters.contact),
      table_(component_table(parameters.fits.functions())),
      largest_ratio_(0),
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
    const double a = largest_fitted_strain * k / 3500;
    if (a <= parameters_.fits.largest_deviator) largest_ratio_ = std::max(largest_ratio_, value(3, a) * a);
  }
  steepest_ = parameters_.fits.scale * steepest_slope([&](double e) { return value(0, e) * e; }, joints);
  if (parameters_.unloading != PrintedUnloading::none) steepest_ *= parameters_.rule.unloading_stiffness;
}

double YuuUmekagePrinted::sound_speed(double density) const {
  return std::sqrt(steepest_ * density_factor(density / grain_density_) / density);
}

std::vector<Problem> YuuUmekagePrinted::check(const Parameters& parameters) {
  return check_reset(parameters.rule.reset, parameters.contact.volume);
}

}  // namespace talus::granular
