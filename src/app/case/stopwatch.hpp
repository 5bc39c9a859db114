// SPDX-License-Identifier: Apache-2.0
/// How long something takes on this machine, now.
#pragma once

#include <chrono>

namespace talus::app {

/// Seconds of one call of `body`, the mean over as many as fit into `duration`; one before them, which fills caches and
/// lists, does not count.
template <class Body>
double seconds_of(double duration, Body&& body) {
  using Clock = std::chrono::steady_clock;
  body();
  const Clock::time_point start = Clock::now();
  double elapsed = 0;
  int calls = 0;
  do {
    body();
    ++calls;
    elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  } while (elapsed < duration);
  return elapsed / calls;
}

}  // namespace talus::app
