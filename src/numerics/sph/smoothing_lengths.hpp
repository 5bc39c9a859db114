// SPDX-License-Identifier: Apache-2.0
/// The smoothing lengths of many particles at once.
#pragma once

#include <cstddef>

namespace talus::sph {

/// The bits of ratio * smoothing_length(mass, density) of each, in vectors. \param mass kg; \param density kg/m^3;
/// \param length m
void smoothing_lengths(std::size_t count, double mass, double ratio, const double* density, double* length);

}  // namespace talus::sph
