// SPDX-License-Identifier: Apache-2.0
/// The file of a part of the vessel.
#pragma once

#include <cstddef>
#include <vector>

#include "base/error.hpp"
#include "models/continuum/setup/vessel.hpp"

namespace talus::continuum {

/// What cannot be mended in the file of the nth of [[vessel]], by triangle and place.
void check_file(const VesselPart& part, std::size_t n, std::vector<Problem>& problems);

}  // namespace talus::continuum
