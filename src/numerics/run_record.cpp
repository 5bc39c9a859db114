// SPDX-License-Identifier: Apache-2.0
#include "numerics/run_record.hpp"

#include <cmath>

namespace talus {

double RunRecord::largest(std::string_view column) const {
  double largest = std::nan("");
  if (series.has(column))
    for (const double value : series.column(column)) largest = std::fmax(largest, value);
  return largest;
}

double RunRecord::value(std::string_view name) const {
  for (const NamedValue& number : summary)
    if (number.name == name) return number.value;
  return std::nan("");
}

}  // namespace talus
