// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/critical_state.hpp"

#include <cmath>

namespace talus::granular {

CriticalState::CriticalState(const Parameters& parameters, double grain_density, double grain_diameter)
    : parameters_(parameters),
      coefficients_{parameters, parameters.reference_packing * grain_density,
                    parameters.reference_packing / parameters.loosest_packing,
                    std::sqrt(2 * grain_density) * grain_diameter} {}

double CriticalState::sound_speed(double density) const {
  return std::sqrt((parameters_.bulk_modulus + 4.0 / 3.0 * parameters_.shear_modulus) / density);
}

std::vector<Problem> CriticalState::check(const Parameters& p) {
  std::vector<Problem> problems;
  if (p.fast_friction < p.friction)
    problems.push_back({.key = "fast_friction",
                        .what = "fast flow would have less friction than slow flow, and would run away",
                        .allowed = "at least friction"});
  if (p.fabric_friction > p.friction)
    problems.push_back({.key = "fabric_friction",
                        .what = "grains whose shear turns back would push on by themselves",
                        .allowed = "at most friction"});
  for (const auto& [key, packing] :
       {std::pair{"critical_packing", p.critical_packing}, std::pair{"reference_packing", p.reference_packing}})
    if (packing < p.loosest_packing)
      problems.push_back({.key = key, .what = "lies below the loosest packing", .allowed = "at least loosest_packing"});
  if (!(p.critical_packing - CriticalStateCoefficients::largest_inertial_number * p.loosening > 0.1))
    problems.push_back({.key = "loosening",
                        .what = "fast flow would have next to no grains",
                        .allowed = "less than (critical_packing - 0.1)/0.3"});
  return problems;
}

}  // namespace talus::granular
