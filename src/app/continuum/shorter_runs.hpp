// SPDX-License-Identifier: Apache-2.0
/// What would shorten the run of a case: a sector, softer grains, single precision, larger particles.
#pragma once

#include <vector>

#include "app/case/prepared_case.hpp"
#include "models/continuum/setup/layout.hpp"

namespace talus::app {

/// Changes that leave what the case asks: none makes grains softer than bulk_modulus_for(). Whether the case bears them
/// (an axisymmetric vessel, enough particles across the outlet) shows when it is read with them.
std::vector<Shortening> shorter_runs(const continuum::Layout& layout, double end);

}  // namespace talus::app
