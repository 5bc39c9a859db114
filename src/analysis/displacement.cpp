// SPDX-License-Identifier: Apache-2.0
#include "analysis/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

namespace talus {

std::vector<double> mean_speeds(const Snapshot& before, const Snapshot& now) {
  const double time = now.time - before.time;
  if (!(time > 0)) throw std::invalid_argument("the first snapshot must be the earlier one");
  std::unordered_map<std::int64_t, Vector3> place;
  const auto earlier = before.integers("identity"), identity = now.integers("identity");
  for (std::size_t i = 0; i < earlier.size(); ++i) place.emplace(earlier[i], before.positions()[i]);
  std::vector<double> speed;
  for (std::size_t i = 0; i < identity.size(); ++i) {
    const auto found = place.find(identity[i]);
    speed.push_back(found == place.end() ? std::numeric_limits<double>::quiet_NaN()
                                         : norm(now.positions()[i] - found->second) / time);
  }
  return speed;
}

}  // namespace talus
