// SPDX-License-Identifier: Apache-2.0
/// Cases of the model `air`.
#pragma once

#include "app/prepared_case.hpp"

namespace talus::app {

/// Reads a case of air alone. \throws InputError with every problem
PreparedCase prepare_air(const CaseFile& file);

/// All parameters of such a case, with their defaults.
ParameterList air_parameters();

/// The quantities of a run's summary: the last row of its series. \param folder of the run
std::vector<NamedValue> analyze_air(const std::filesystem::path& folder);

}  // namespace talus::app
