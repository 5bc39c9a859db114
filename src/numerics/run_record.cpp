// SPDX-License-Identifier: Apache-2.0
#include "numerics/run_record.hpp"

#include <cmath>
#include <span>

namespace talus {

double RunRecord::largest(std::string_view column, double from) const {
  double largest = std::nan("");
  if (!series.has(column)) return largest;
  const std::span<const double> values = series.column(column);
  const bool is_timed = series.has("time");
  for (std::size_t n = 0; n < values.size(); ++n)
    if (!is_timed || series.column("time")[n] >= from) largest = std::fmax(largest, values[n]);
  return largest;
}

double RunRecord::value(std::string_view name) const {
  for (const NamedValue& number : summary)
    if (number.name == name) return number.value;
  return std::nan("");
}

}  // namespace talus
