// SPDX-License-Identifier: Apache-2.0
/// Keys of cases of the continuum model that were, and what stands in their place: the one table of them.
#pragma once

#include "base/parameter.hpp"

namespace talus::continuum {

inline constexpr RenamedKey renamed_keys[] = {
    {"law.form", "law.name = \"yuu-umekage\" (was isotropic) or \"yuu-umekage-printed\" (was printed)"},
    {"law.tables", "tables in the law's own table: law.yuu-umekage.tables"},
    {"law.scale", "scale in the law's own table: law.yuu-umekage.scale, law.drucker-prager.scale"},
    {"law.largest_deviator", "largest_deviator in the law's own table: law.yuu-umekage.largest_deviator"},
    {"law.reference_packing", "reference_packing in the law's own table: law.yuu-umekage.reference_packing"},
    {"law.volume", "volume in the law's own table: law.yuu-umekage.volume"},
    {"law.compaction", "compaction in the law's own table: law.yuu-umekage.compaction"},
    {"law.gate_packing", "gate_packing in the law's own table: law.yuu-umekage.gate_packing"},
    {"law.gate_power", "gate_power in the law's own table: law.yuu-umekage.gate_power"},
    {"law.close_packing", "law.yuu-umekage.close_packing"},
    {"law.unloading", "unloading in the law's own table: law.yuu-umekage.unloading"},
    {"law.unloading_stiffness", "unloading_stiffness in the law's own table: law.yuu-umekage.unloading_stiffness"},
    {"law.reset", "reset in the law's own table: law.yuu-umekage.reset"},
    {"law.main_strain", "main_strain in the law's own table: law.yuu-umekage.main_strain"},
    {"law.smoothing_time", "smoothing_time in the law's own table: law.yuu-umekage.smoothing_time"},
    {"law.strain", "law.yuu-umekage-printed.strain"},
    {"law.shear_sum", "law.yuu-umekage-printed.shear_sum"},
    {"law.friction", "law.drucker-prager.friction"},
    {"law.lambda", "law.linear-elastic.lambda"},
    {"law.shear_modulus", "law.linear-elastic.shear_modulus"},
    {"law.collisions", "collisions.form"},
    {"law.collision_normal", "collisions.normal"},
    {"law.collision_shear", "collisions.shear"},
    {"law.collision_diagonal", "collisions.diagonal"},
};

}  // namespace talus::continuum
