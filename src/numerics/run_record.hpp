// SPDX-License-Identifier: Apache-2.0
/// What is on record of a run when it is done: what its card judges it by, whoever prints it and whenever.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "numerics/named_value.hpp"
#include "numerics/series.hpp"

namespace talus {

struct RunRecord {
  Series series;                    ///< of all steps
  std::vector<NamedValue> summary;  ///< what the analysis made

  /// Largest value of a column from a time on, those that are none left out; nan if there is none, or no such column.
  double largest(std::string_view column, double from = -std::numeric_limits<double>::infinity()) const;
  /// A number of the summary; nan if it has none of that name.
  double value(std::string_view name) const;
};

}  // namespace talus
