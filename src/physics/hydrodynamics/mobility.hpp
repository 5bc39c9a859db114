// SPDX-License-Identifier: Apache-2.0
/// The choice among the laws by which spheres in a viscous fluid drag each other. Plain, because files compiled for one
/// instruction set include it; the names for case files are in mobility_names.hpp.
#pragma once

namespace talus::hydrodynamics {

enum class Mobility {
  rotne_prager_1969,  ///< as Niiya et al. 2020 print it, with the source's radius alone (rotne_prager.hpp)
  zuk_2014,           ///< symmetric and positive definite for unequal and overlapping spheres (zuk.hpp)
  none                ///< no interaction through the fluid: each sphere has its own Stokes drag (stokes.hpp)
};

}  // namespace talus::hydrodynamics
