// SPDX-License-Identifier: Apache-2.0
/// The mobilities' names in case files.
#pragma once

#include <array>
#include <string_view>

#include "base/parameter.hpp"
#include "physics/hydrodynamics/mobility.hpp"

namespace talus {
template <>
inline constexpr auto choices<hydrodynamics::Mobility> = std::to_array<std::string_view>({"rotne-prager-1969",
                                                                                          "zuk-2014", "none"});
}
