// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/stability.hpp"

#include "numerics/chebyshev.hpp"
#include "numerics/dormand_prince.hpp"
#include "physics/hydrodynamics/stokes.hpp"

namespace talus::cloud {

double contact_rate(const Parameters& p) {
  if (!p.contact.enabled) return 0;
  const double lattice = p.fluid.mobility == hydrodynamics::Mobility::none ? 6.0 : 1.5;
  return lattice * p.contact.stiffness * hydrodynamics::stokes_mobility(p.particles.radius, p.fluid.viscosity);
}

double longest_stable_step(const Parameters& p, double rate) {
  if (p.integration.method == Method::dormand_prince) return dormand_prince::stability / rate;
  constexpr int most_stages = 250;
  return chebyshev_stages(p.integration.method == Method::euler ? 1 : most_stages, stage_damping).stability / rate;
}

}  // namespace talus::cloud
