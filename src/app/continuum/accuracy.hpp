// SPDX-License-Identifier: Apache-2.0
/// Settings that follow from one word: how accurate a run is to be.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/case_file.hpp"
#include "models/continuum/setup/setup.hpp"

namespace talus::app {

/// Sectors, the narrowest first, as alternatives of a setting: "box.sector=10 deg", ...
std::vector<std::string> sector_settings();

/// "41.6 mm": a length in millimetres, rounded downwards to four digits.
std::string millimetres(double length);

/// Reads a case and builds its setup. \throws InputError
using ReadSetup = std::function<std::shared_ptr<const continuum::Setup>(const CaseFile& file)>;

/// The case with what its key `accuracy` sets of the keys that it leaves out: bed.spacing by the outlet, single
/// precision, the narrowest sector that warns of nothing that the whole does not warn of, coarser particles away from
/// the outlet. The moduli of the law
/// critical-state follow from the bed (bulk_modulus_for). Without the key, and of what it does not set, the case
/// itself. \throws InputError with every problem
CaseFile with_accuracy(const CaseFile& file, const ReadSetup& read);

}  // namespace talus::app
