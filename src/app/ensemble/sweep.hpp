// SPDX-License-Identifier: Apache-2.0
/// The table of a sweep: each combination of the varied keys against the quantities that its members came to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/ensemble/plan.hpp"
#include "app/ensemble/statistics.hpp"
#include "base/unit.hpp"

namespace talus::app {

struct SweptGroup {
  const EnsembleGroup* group;
  std::vector<QuantitySpread> spreads;
};

/// One of a group's varied keys.
struct Setting {
  std::string key, text;
  std::optional<Quantity> quantity;  ///< none: a name, an array
};
std::vector<Setting> settings_of(const EnsembleGroup& group);

/// Name and unit of every quantity that a group has, in the order in which the groups have them.
std::vector<const QuantitySpread*> all_quantities(const std::vector<SweptGroup>& groups);

/// Null if no member of the group has it.
const QuantitySpread* find_quantity(const SweptGroup& swept, const std::string& name);

/// "1.234", or "1.234 ± 0.05" of two members and more; "-" of none.
std::string mean_and_deviation(const QuantitySpread& spread);

/// A line per quantity, a column per group, in blocks that a terminal holds.
std::string sweep_text(const std::vector<SweptGroup>& groups);

/// Writes sweep.csv (a row per group: the varied keys in SI and degrees, number of members, mean of each quantity and,
/// where groups have two members and more, its standard deviation) and sweep.json (the same, the values also as they
/// were given). \throws FileError
void write_sweep(const std::vector<SweptGroup>& groups, const std::filesystem::path& folder);

/// \throws InputError with the nearest name for each quantity asked for that is not known
void check_quantities(const std::vector<std::string>& asked, const std::vector<std::string>& known);

}  // namespace talus::app
