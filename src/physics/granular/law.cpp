// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/law.hpp"

#include <optional>

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

}  // namespace talus::granular
