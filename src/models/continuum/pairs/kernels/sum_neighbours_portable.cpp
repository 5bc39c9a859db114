// SPDX-License-Identifier: Apache-2.0
/// The sums over neighbours, compiled for one instruction set.
#include "models/continuum/pairs/kernels/sum_neighbours.hpp"

namespace talus::continuum {

SumNeighbours sum_neighbours_portable(PairTerms terms, Stabilisers stabilisers, PairPrecision precision,
                                      StressAround stress_around, StressGradient stress_gradient) {
  return choose(terms, stabilisers, precision, stress_around, stress_gradient);
}

void velocity_gradients_portable(const ParticleSums* sums, double (*gradient)[ParticleSums::together]) {
  velocity_gradients(sums, gradient);
}

}  // namespace talus::continuum
