// SPDX-License-Identifier: Apache-2.0
#include "numerics/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <stdexcept>

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

bool Series::has(std::string_view name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::span<const double> Series::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::out_of_range(fmt::format("no column '{}'; there are: {}", name, fmt::join(names, ", ")));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

namespace {

std::string id_of(const std::string& quantity) {
  std::string id;
  for (const char c : quantity) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      id += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!id.empty() && id.back() != '-')
      id += '-';
  }
  while (!id.empty() && id.back() == '-') id.pop_back();
  return id;
}

}  // namespace

std::vector<Warning> warnings_of(const std::vector<RegimeLine>& lines) {
  std::vector<Warning> warnings;
  for (const RegimeLine& line : lines)
    if (line.warning)
      warnings.push_back({id_of(line.quantity), line.quantity + " = " + line.value + ": " + line.meaning});
  return warnings;
}

std::string to_string(const Warning& warning) {
  return warning.id + ": " + warning.text;
}

}  // namespace talus
