// SPDX-License-Identifier: Apache-2.0
/// The quantities of quantities.hpp that describe an avalanche, by name: of a run, of an ensemble, of ensembles at
/// several radii. Definitions in full: validation/niiya2020/reference.toml. A number that the runs do not have is nan.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/avalanche.hpp"
#include "analysis/comparison.hpp"
#include "numerics/named_value.hpp"

namespace talus {

/// A quantity of one run. \throws std::out_of_range for a name that is not one of a single run
double run_quantity(std::string_view name, const AvalancheRun& run, const Window& window);

/// A quantity of a row: the statistic of its members' quantities (From::each), that of the members' mean curves or
/// their spread (curves), or that of all their values (values). Nothing if that takes more members than there are.
/// \throws std::out_of_range for an unknown name
std::optional<double> ensemble_quantity(const ComparisonRow& row, std::span<const AvalancheRun> members);

/// A quantity of several radii together (From::variants), one ensemble a radius. Nothing for fewer than three
/// ensembles. \throws std::out_of_range for an unknown name
std::optional<double> radii_quantity(const ComparisonRow& row, std::span<const std::vector<AvalancheRun>> ensembles);

/// What summary.json lists of a run: front speeds over the whole run, sizes of the largest head and frontal angle at
/// the end, the aspect ratio as the mean over t > 6 a/v_s.
std::vector<NamedValue> avalanche_summary(const AvalancheRun& run, AvalancheView view);

}  // namespace talus
