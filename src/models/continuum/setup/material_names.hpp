// SPDX-License-Identifier: Apache-2.0
/// Grains and walls that a case may name. Their values, with ranges and sources, are in the files of materials/.
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "base/parameter.hpp"

namespace talus::continuum {

/// One for each file of materials/.
enum class GrainMaterial { glass_beads, sand, wheat, maize };
/// What a wall is made of. A file says how its grains rub on it.
enum class WallMaterial { steel, acrylic, glass, concrete };

/// Where the values of a material hold.
struct MaterialRange {
  double least_diameter = 0, largest_diameter = std::numeric_limits<double>::infinity();  ///< of its grains, m
  double largest_pressure = std::numeric_limits<double>::infinity();                      ///< Pa
};

}  // namespace talus::continuum

namespace talus {
template <>
inline constexpr auto choices<continuum::GrainMaterial> = std::to_array<std::string_view>({"glass-beads", "sand",
                                                                                           "wheat", "maize"});
template <>
inline constexpr auto choices<continuum::WallMaterial> = std::to_array<std::string_view>({"steel", "acrylic", "glass",
                                                                                          "concrete"});
}  // namespace talus
