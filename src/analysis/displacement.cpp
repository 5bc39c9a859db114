// SPDX-License-Identifier: Apache-2.0
#include "analysis/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

DisplacementSpread displacement_spread(std::span<const Vector3> before, std::span<const Vector3> after) {
  if (before.empty() || before.size() != after.size())
    throw std::invalid_argument("displacements need the same grains before and after");
  Vector3 mean;
  for (std::size_t i = 0; i < before.size(); ++i)
    mean += 1.0 / static_cast<double>(before.size()) * (after[i] - before[i]);
  DisplacementSpread spread{.mean = mean.x};
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vector3 d = after[i] - before[i] - mean;
    spread.along = std::max(spread.along, std::abs(d.x));
    spread.lateral = std::max(spread.lateral, std::abs(d.y));
  }
  return spread;
}

}  // namespace talus
