// SPDX-License-Identifier: Apache-2.0
/// Whether a case keeps to what the model and its law were made for: the lines of the regime card that are known before
/// the run.
#pragma once

#include <vector>

#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/setup/setup.hpp"
#include "numerics/run_record.hpp"

namespace talus::continuum {

std::vector<RegimeLine> regime_of_case(const Setup& setup);

/// The line of a time step's Courant number. \param courant step times speed of sound over smoothing length
RegimeLine courant_line(Method method, double courant);

/// The same of the step that the case gives, before the run.
RegimeLine courant_of_case(const Setup& setup);

}  // namespace talus::continuum
