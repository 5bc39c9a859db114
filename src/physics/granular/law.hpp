// SPDX-License-Identifier: Apache-2.0
/// The law that follows from what a case says (law_options.hpp). The loop over the grains visits the variant once,
/// outside.
#pragma once

#include <variant>

#include "physics/granular/collisional_stress.hpp"
#include "physics/granular/drucker_prager.hpp"
#include "physics/granular/law_options.hpp"
#include "physics/granular/linear_elastic.hpp"
#include "physics/granular/yuu_umekage_isotropic.hpp"
#include "physics/granular/yuu_umekage_printed.hpp"

namespace talus::granular {

using AnyLaw = std::variant<YuuUmekageIsotropic, YuuUmekagePrinted, DruckerPrager, LinearElastic>;

/// \param grain_density rho_p, kg/m^3
AnyLaw make_law(const LawParameters& parameters, double grain_density);

/// \param diameter D_p, m; \param gravity m/s^2; no collisions: B1 = B2 = 0
CollisionOptions collision_options(const LawParameters& parameters, double diameter, double gravity);

}  // namespace talus::granular
