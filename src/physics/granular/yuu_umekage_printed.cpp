// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/yuu_umekage_printed.hpp"

#include <algorithm>
#include <cmath>

#include "physics/granular/uniaxial_slope.hpp"

namespace talus::granular {

YuuUmekagePrinted::YuuUmekagePrinted(const YuuUmekageOptions& options, const FittedFunctions& functions)
    : options_(options),
      memory_(options.volume, options.reference_packing, options.gate_packing, options.compaction),
      table_(component_table(functions)),
      initial_{functions.a1.piece[0].c0, functions.a2.piece[0].c0, functions.a3.piece[0].c0, functions.a4.piece[0].c0},
      largest_ratio_(0),
      inverse_grain_density_(1 / options.grain_density) {
  const auto value = [&](int function, double a) {
    double A[4];
    table_.evaluate(a, A);
    return A[function];
  };
  std::vector<double> joints;
  for (int k = 0; k < table_.pieces(); ++k) joints.push_back(table_.end(k));
  for (int k = 1; k <= 3500; ++k) {
    const double a = largest_fitted_strain * k / 3500;
    if (a <= options_.largest_deviator) largest_ratio_ = std::max(largest_ratio_, value(3, a) * a);
  }
  steepest_ = options_.scale * steepest_slope([&](double e) { return value(0, e) * e; }, joints);
  if (options_.unloading != Unloading::none) steepest_ *= options_.unloading_stiffness;
}

double YuuUmekagePrinted::sound_speed(double density) const {
  return std::sqrt(steepest_ * density_factor(density / options_.grain_density) / density);
}

}  // namespace talus::granular
