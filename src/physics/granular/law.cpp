// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/law.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "physics/granular/critical_state.hpp"
#include "physics/granular/drucker_prager.hpp"

namespace talus::granular {

std::vector<Problem> check(const LawParameters& parameters) {
  return with_chosen_law(parameters, []<class Law>(const typename Law::Parameters& own) {
    std::vector<Problem> problems;
    if constexpr (requires { Law::check(own); }) problems = Law::check(own);
    for (Problem& problem : problems) problem.key = table_of_law<Law>() + "." + problem.key;
    return problems;
  });
}

AnyLaw make_law(const LawParameters& parameters, double grain_density, double grain_diameter) {
  return *with_chosen_law(parameters, [&]<class Law>(const typename Law::Parameters& own) {
    if constexpr (std::constructible_from<Law, const typename Law::Parameters&, double, double>)
      return std::optional<AnyLaw>(Law(own, grain_density, grain_diameter));
    else
      return std::optional<AnyLaw>(Law(own, grain_density));
  });
}

CriticalState::CriticalState(const Parameters& parameters, double grain_density, double grain_diameter)
    : parameters_(parameters),
      coefficients_{parameters, parameters.reference_packing * grain_density,
                    parameters.reference_packing / parameters.random_loose_packing,
                    std::sqrt(2 * grain_density) * grain_diameter} {}

double CriticalState::sound_speed(double density) const {
  return std::sqrt((parameters_.bulk_modulus + 4.0 / 3.0 * parameters_.shear_modulus) / density);
}

std::vector<Problem> CriticalState::check(const Parameters& p) {
  std::vector<Problem> problems;
  if (p.dynamic_friction < p.static_friction)
    problems.push_back({.key = "dynamic_friction",
                        .what = fmt::format("{:g}, and static_friction {:g}: fast flow would have less friction than "
                                            "slow flow, and would run away",
                                            p.dynamic_friction, p.static_friction),
                        .allowed = "at least static_friction"});
  for (const auto& [key, packing] :
       {std::pair{"critical_packing", p.critical_packing}, std::pair{"reference_packing", p.reference_packing}})
    if (packing < p.random_loose_packing)
      problems.push_back(
          {.key = key, .what = "lies below the loosest packing", .allowed = "at least random_loose_packing"});
  if (!(p.critical_packing - CriticalStateCoefficients::max_inertial_number * p.packing_slope > 0.1))
    problems.push_back({.key = "packing_slope",
                        .what = "fast flow would have next to no grains",
                        .allowed = "less than (critical_packing - 0.1)/0.3"});
  if (p.strength_at_start() > CriticalStateCoefficients::max_strength * p.bulk_modulus)
    problems.push_back({.key = p.consolidation_strength > 0 ? "consolidation" : "tensile_strength",
                        .what = "grains would stretch by more than a tenth of their volume before they part",
                        .allowed = "a tensile strength of at most 0.1 bulk_modulus"});
  return problems;
}

DruckerPrager::DruckerPrager(const Parameters& parameters, double grain_density)
    : parameters_(parameters),
      memory_(parameters.contact),
      shear_(shear_table(parameters.fits.functions())),
      inverse_grain_density_(1 / grain_density) {
  const Fits& fits = parameters.fits;
  if (!(fits.max_deviator <= max_fitted_strain))
    throw std::invalid_argument("the largest deviator lies beyond the range of the fits");
  const FittedFunctions& functions = fits.functions();
  const double lambda = fits.scale * functions.a2.piece[0].c0;
  two_g_ = fits.scale * (functions.a1.piece[0].c0 - functions.a2.piece[0].c0);
  inverse_two_g_ = 1 / two_g_;
  bulk_ = lambda + two_g_ / 3;
}

double DruckerPrager::sound_speed(double density) const {
  return std::sqrt((bulk_ + 2.0 / 3.0 * two_g_) / density);
}

}  // namespace talus::granular
