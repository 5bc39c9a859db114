// SPDX-License-Identifier: Apache-2.0
/// When a gate is away. Times from the opening of the gate of the case, s.
#pragma once

#include <optional>

namespace talus {

struct GateTimes {
  double opens_after = 0;
  std::optional<double> closes_after;   ///< left out: it stays away
  std::optional<double> repeats_every;  ///< of one that closes, longer than it is away

  /// \param time infinite: at the end, where what repeats is shut
  bool is_away(double time) const;
  /// When it closed last before a time at which it is not away; nothing if it has not.
  std::optional<double> closed_before(double time) const;
  /// For how long it has been away until a time.
  double time_away(double until) const;
  double time_away(double from, double to) const { return time_away(to) - time_away(from); }
};

}  // namespace talus
