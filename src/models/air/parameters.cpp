// SPDX-License-Identifier: Apache-2.0
#include "models/air/parameters.hpp"

#include <fmt/format.h>

#include <string>

namespace talus::air {

std::vector<Problem> check(const Parameters& p) {
  constexpr const char* names[6] = {"left", "right", "front", "rear", "floor", "top"};
  std::vector<Problem> problems;
  for (std::size_t face = 0; face < 6; ++face) {
    const auto& velocity = p.wall_velocity[face];
    const bool moves = velocity != std::array<double, 3>{};
    const std::string key = fmt::format("air.{}_velocity", names[face]);
    if (moves && p.boundaries.kind[face] != FlowBoundary::no_slip)
      problems.push_back(
          {.key = key,
           .what = fmt::format("given, but air.{} is \"{}\"", names[face], choice_name(p.boundaries.kind[face])),
           .allowed = fmt::format("air.{} = \"wall\"", names[face])});
    if (velocity[face / 2] != 0)
      problems.push_back({.key = key,
                          .what = fmt::format("the wall would move along {}, across itself", "xyz"[face / 2]),
                          .allowed = fmt::format("0 m/s along {}", "xyz"[face / 2])});
  }
  return problems;
}

}  // namespace talus::air
