// SPDX-License-Identifier: Apache-2.0
/// What a case of the continuum can choose, and the words for it.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.hpp"
#include "models/continuum/pairs/kernels/kernel.hpp"

namespace talus::continuum {

/// How accurate a run is to be: what follows is in app/continuum/accuracy.hpp.
enum class Accuracy { draft, design, reference };
enum class GateOpens { when_settled, at_time, from_the_start };
enum class Smoothing { local, fixed };
enum class Friction { coulomb, printed, none };
enum class FrictionFrom { gate, start };
/// How a bed gets its weight: everywhere at once, or layer by layer from below.
enum class Filling { at_once, layers };
enum class Method { runge_kutta, leapfrog };

/// Two thirds of what the leapfrog bears, and what the midpoint rule does
/// (docs/design/time-steps.md).
constexpr double default_courant(Method method) {
  return method == Method::leapfrog ? 1.2 : 0.3;
}

/// One for each file of materials/.
enum class GrainMaterial { glass_beads, sand, wheat, maize, soybean, rapeseed, pharma_powder, cement };
/// What a wall is made of. A file says how its grains rub on it.
enum class WallMaterial { steel, acrylic, glass, concrete };

/// A value that a case sets beyond the range of its material, and that range, as they are written.
struct ValueBeyond {
  std::string key, value, range;
};

/// Where the values of a material hold.
struct MaterialRange {
  std::string name = {};                                                            ///< the material's; empty: none
  double min_diameter = 0, max_diameter = std::numeric_limits<double>::infinity();  ///< of its grains, m
  double max_pressure = std::numeric_limits<double>::infinity();                    ///< Pa
  std::vector<ValueBeyond> beyond = {};                                             ///< but for the diameter
};

inline constexpr RenamedKey renamed_keys[] = {
    {"law.form", "law.name = \"yuu-umekage\" (was isotropic) or \"yuu-umekage-printed\" (was printed)"},
    {"law.tables", "tables in the law's own table: law.yuu-umekage.tables"},
    {"law.scale", "scale in the law's own table: law.yuu-umekage.scale, law.drucker-prager.scale"},
    {"law.largest_deviator", "max_deviator in the law's own table: law.yuu-umekage.max_deviator"},
    {"law.reference_packing", "reference_packing in the law's own table: law.yuu-umekage.reference_packing"},
    {"law.volume", "volume in the law's own table: law.yuu-umekage.volume"},
    {"law.compaction", "compaction in the law's own table: law.yuu-umekage.compaction"},
    {"law.gate_packing", "gate_packing in the law's own table: law.yuu-umekage.gate_packing"},
    {"law.gate_power", "gate_power in the law's own table: law.yuu-umekage.gate_power"},
    {"law.close_packing", "law.yuu-umekage.close_packing"},
    {"law.unloading", "unloading in the law's own table: law.yuu-umekage.unloading"},
    {"law.unloading_stiffness", "unloading_stiffness in the law's own table: law.yuu-umekage.unloading_stiffness"},
    {"law.reset", "reset in the law's own table: law.yuu-umekage.reset"},
    {"law.smoothing_time", "smoothing_time in the law's own table: law.yuu-umekage.smoothing_time"},
    {"law.strain", "law.yuu-umekage-printed.strain"},
    {"law.shear_sum", "law.yuu-umekage-printed.shear_sum"},
    {"law.friction", "law.drucker-prager.friction"},
    {"law.lambda", "law.linear-elastic.lambda"},
    {"law.shear_modulus", "law.linear-elastic.shear_modulus"},
    {"law.collisions", "collisions.form"},
    {"law.collision_normal", "collisions.normal"},
    {"law.collision_shear", "collisions.shear"},
    {"law.critical-state.friction", "law.critical-state.static_friction"},
    {"law.critical-state.fast_friction", "law.critical-state.dynamic_friction"},
    {"law.critical-state.loosest_packing", "law.critical-state.random_loose_packing"},
    {"law.critical-state.loosening", "law.critical-state.packing_slope"},
    {"law.critical-state.strength_at_rest", "law.critical-state.ageing_strength"},
    {"law.critical-state.strength_adds", "law.critical-state.ageing_adds"},
    {"law.critical-state.healing_time", "law.critical-state.ageing_time"},
    {"law.critical-state.breaking_strain", "law.critical-state.ageing_strain"},
    {"law.yuu-umekage.largest_deviator", "law.yuu-umekage.max_deviator"},
    {"law.yuu-umekage-printed.largest_deviator", "law.yuu-umekage-printed.max_deviator"},
    {"law.drucker-prager.largest_deviator", "law.drucker-prager.max_deviator"},
    {"settle.longest", "settle.max_time"},
    {"air.longest_step", "air.max_step"},
    {"air.most_iterations", "air.max_iterations"},
    {"path.largest_increment", "path.max_increment"},
};

}  // namespace talus::continuum

namespace talus {
template <>
inline constexpr auto choices<continuum::GateOpens> = std::to_array<std::string_view>({"when-settled", "at-time",
                                                                                       "from-the-start"});
template <>
inline constexpr auto choices<continuum::Accuracy> = std::to_array<std::string_view>({"draft", "design", "reference"});
template <>
inline constexpr auto choices<continuum::Smoothing> = std::to_array<std::string_view>({"local", "fixed"});
template <>
inline constexpr auto choices<continuum::Friction> = std::to_array<std::string_view>({"coulomb", "printed", "none"});
template <>
inline constexpr auto choices<continuum::FrictionFrom> = std::to_array<std::string_view>({"gate", "start"});
template <>
inline constexpr auto choices<continuum::Filling> = std::to_array<std::string_view>({"at-once", "layers"});
template <>
inline constexpr auto choices<continuum::PairPrecision> = std::to_array<std::string_view>({"double", "single"});
template <>
inline constexpr auto choices<continuum::Method> = std::to_array<std::string_view>({"runge-kutta", "leapfrog"});

template <>
inline constexpr auto choices<continuum::GrainMaterial> = std::to_array<std::string_view>(
    {"glass-beads", "sand", "wheat", "maize", "soybean", "rapeseed", "pharma-powder", "cement"});
template <>
inline constexpr auto choices<continuum::WallMaterial> = std::to_array<std::string_view>({"steel", "acrylic", "glass",
                                                                                          "concrete"});

}  // namespace talus
