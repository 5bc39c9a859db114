// SPDX-License-Identifier: Apache-2.0
/// The quantities of quantities.hpp that describe grains run from a hopper into a bin, by name: of a run, of two runs
/// against each other. Definitions in full: validation/yuu2011/reference.toml. A number that a run does not have, or a
/// window that it does not cover, is nan.
#pragma once

#include <string_view>
#include <vector>

#include "analysis/comparison.hpp"
#include "analysis/hopper.hpp"
#include "numerics/named_value.hpp"

namespace talus {

/// A quantity of one run. Times of the window in s from the gate's opening. \throws std::out_of_range for a name that
/// is not one of a single run
double hopper_quantity(std::string_view name, const HopperRun& run, const Window& window);

/// A quantity of two runs, the first against the second. \throws std::out_of_range for an unknown name
double hopper_pair_quantity(std::string_view name, const HopperRun& first, const HopperRun& second,
                            const Window& window);

/// What summary.json lists of a run, each over the window that docs/quantities.md says. Quantities that the case has no
/// place for (a slit's without a plate) are left out.
std::vector<NamedValue> hopper_summary(const HopperRun& run);

/// Mass of the particles below the plate against the time from the gate's opening, kg. Without points if the series
/// lacks the column.
Curve discharged_mass(const HopperRun& run);
/// The same over the mass of all particles at the start.
Curve discharged_share(const HopperRun& run);

/// Integral of the discharge Q, kg: of particles spread along z by the kernel. Of this all rates are made: counted
/// whole, the particles' layers would pass one by one, with a period h/u of their own.
Curve passed_mass(const HopperRun& run);

}  // namespace talus
