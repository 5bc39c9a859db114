// SPDX-License-Identifier: Apache-2.0
/// Particles of bed.file.
#pragma once

#include <vector>

#include "models/continuum/setup/parameters.hpp"

namespace talus::continuum {

/// Particles that the case cannot begin with: outside the box, too near to each other, without a positive density, or
/// not finite; the first of them and their count. \pre bed.given
std::vector<Problem> check_given_bed(const Parameters& parameters);

}  // namespace talus::continuum
