// SPDX-License-Identifier: Apache-2.0
/// The loop over near pairs, compiled for one instruction set.
#include "models/cloud/spectral_sum/sum_near.hpp"

namespace talus::cloud {

SumNear<float> sum_near_avx512(hydrodynamics::Mobility mobility, int degree) {
  return choose_near<float>(mobility, degree);
}

SumNear<double> sum_near_double_avx512(hydrodynamics::Mobility mobility, int degree) {
  return choose_near<double>(mobility, degree);
}

}  // namespace talus::cloud
