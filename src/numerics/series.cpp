// SPDX-License-Identifier: Apache-2.0
#include "numerics/series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace talus {

bool Series::has(std::string_view name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::span<const double> Series::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw std::out_of_range(fmt::format("no column '{}'; there are: {}", name, fmt::join(names, ", ")));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace talus
