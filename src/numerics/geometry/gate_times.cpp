// SPDX-License-Identifier: Apache-2.0
#include "numerics/geometry/gate_times.hpp"

#include <algorithm>
#include <cmath>

namespace talus {

bool GateTimes::is_away(double time) const {
  if (time < opens_after) return false;
  if (!closes_after) return true;
  if (std::isinf(time)) return false;
  const double since = repeats_every ? std::fmod(time - opens_after, *repeats_every) : time - opens_after;
  return since < *closes_after - opens_after;
}

std::optional<double> GateTimes::closed_before(double time) const {
  if (!closes_after || time < opens_after) return std::nullopt;
  const double times = repeats_every ? std::floor((time - opens_after) / *repeats_every) : 0;
  return *closes_after + times * repeats_every.value_or(0);
}

double GateTimes::time_away(double until) const {
  if (!(until > opens_after)) return 0;
  const double since = until - opens_after;
  if (!closes_after) return since;
  const double each = *closes_after - opens_after;
  if (!repeats_every) return std::min(since, each);
  const double times = std::floor(since / *repeats_every);
  return times * each + std::min(since - times * *repeats_every, each);
}

}  // namespace talus
