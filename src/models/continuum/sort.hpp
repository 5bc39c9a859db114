// SPDX-License-Identifier: Apache-2.0
/// Particles near in space are kept near in memory: half of the time of pair sums over many particles hangs on it.
#pragma once

#include "models/continuum/state.hpp"

namespace talus::continuum {

/// Re-orders every column of the state along a space-filling curve. \param cell_size of its cells, m
void sort_for_locality(State& state, double cell_size);

}  // namespace talus::continuum
