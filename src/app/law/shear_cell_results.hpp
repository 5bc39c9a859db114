// SPDX-License-Identifier: Apache-2.0
/// What `talus shear-cell` writes of its tests.
#pragma once

#include <filesystem>
#include <span>

#include "physics/granular/shear_cell.hpp"

namespace talus::app {

/// yield-loci.csv, triaxial.csv, with a wall wall-yield-loci.csv: a row for each sample; flow-function.csv: a row for
/// each load of pre-shear. \throws FileError
void write_shear_tables(std::span<const granular::ShearTest> tests, const std::filesystem::path& folder);

/// As the trade draws them: yield loci with points of failure and of pre-shear and the two Mohr circles of each, below
/// them wall yield loci, thin; the
/// flow function between the lines ff_c = 1, 2, 4 and 10. \throws FileError
void write_shear_figure(std::span<const granular::ShearTest> tests, const std::filesystem::path& file);

}  // namespace talus::app
