// SPDX-License-Identifier: Apache-2.0
/// Warnings: the lines of a regime card that leave what their laws assume, under names that stay.
#pragma once

#include <string>
#include <vector>

#include "numerics/named_value.hpp"

namespace talus {

struct Warning {
  std::string id;    ///< of the line's quantity, in small letters with hyphens: "particles-across-the-outlet"
  std::string text;  ///< "particles across the outlet = 5: fewer than 12 are few"
};

/// Of the lines that warn, in their order.
std::vector<Warning> warnings_of(const std::vector<RegimeLine>& lines);

/// "particles-across-the-outlet: particles across the outlet = 5: ..."
std::string to_string(const Warning& warning);

}  // namespace talus
