// SPDX-License-Identifier: Apache-2.0
#include "base/parameter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace talus {

Range friction_coefficient() {
  return {.least = 0, .most = 2, .hint = [](double value) -> std::string {
            if (!(value > 2 && value < 90)) return {};
            return fmt::format("{:g} looks like an angle in degrees, whose tangent is {:.2f}", value,
                               std::tan(value * std::numbers::pi / 180));
          }};
}

}  // namespace talus
