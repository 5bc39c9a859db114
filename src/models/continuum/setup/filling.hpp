// SPDX-License-Identifier: Apache-2.0
/// A bed of a given mass.
#pragma once

#include "models/continuum/setup/layout.hpp"

namespace talus::continuum {

/// The same with the height of each bed as its mass needs it: a whole number of spacings, or as the particles of
/// bed.file have it. Unchanged without both, and where lengths are missing or the vessel does not hold that mass
/// (check() says so).
Layout with_level(const Layout& layout);

/// Particles of bed.mass, to the nearest. \pre bed.mass is given, no [[beds]]
double count_of_mass(const Parameters& parameters);

/// What is wrong with bed.mass, if anything. \param layout with_level(), no [[beds]]
std::vector<Problem> check_mass(const Layout& layout);

}  // namespace talus::continuum
