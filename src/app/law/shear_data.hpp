// SPDX-License-Identifier: Apache-2.0
/// Yield loci as shear testers export them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "physics/granular/shear_cell.hpp"

namespace talus::app {

/// Points of failure after one consolidation, and what the trade derives from them.
struct MeasuredLocus {
  double consolidation = 0;  ///< normal stress of pre-shear, Pa
  std::optional<double> bulk_density = {};
  std::optional<double> major = {};               ///< sigma_1, where the file has it, Pa
  std::vector<granular::YieldPoint> points = {};  ///< without pre-shear
  granular::YieldLocus locus = {};
};

/// Either a row for each point: consolidation, normal_stress, shear_stress, where the row of a normal stress equal to
/// the consolidation is pre-shear; or one for each locus: friction_angle, cohesion or unconfined_strength,
/// consolidation or major_stress or both; bulk_density is welcome in both. Of several rows of pre-shear the mean counts
/// (ASTM D6128, D6773). A locus without pre-shear ends on its own line. Every column has its unit in the header. Of an
/// evaluated locus sigma_pre follows from sigma_1 as of a law whose pre-shear lies on the line. \throws FileError;
/// InputError with all that is wrong: units, stresses that no shear tester has, too few points, loci of one
/// consolidation, angles out of 0 to 80 deg, ff_c below 1
std::vector<MeasuredLocus> read_shear_data(const std::filesystem::path& path);

/// normal_stress and shear_stress of a wall yield locus, three points at least, under loads that differ. \throws as
/// read_shear_data
std::vector<granular::YieldPoint> read_wall_data(const std::filesystem::path& path);

}  // namespace talus::app
