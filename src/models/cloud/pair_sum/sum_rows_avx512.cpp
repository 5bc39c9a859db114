// SPDX-License-Identifier: Apache-2.0
/// The loop over pairs, compiled for one instruction set.
#include "models/cloud/pair_sum/sum_rows.hpp"

namespace talus::cloud {

SumRows sum_rows_avx512(hydrodynamics::Mobility mobility, std::size_t dimensions, bool single_precision) {
  return choose(mobility, dimensions, single_precision);
}

}  // namespace talus::cloud
