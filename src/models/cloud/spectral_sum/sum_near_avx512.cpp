// SPDX-License-Identifier: Apache-2.0
/// The loop over near pairs, compiled for one instruction set.
#include "models/cloud/spectral_sum/sum_near.hpp"

namespace talus::cloud {

using hydrodynamics::Mobility;

template <>
SumNear<float, 2> sum_near_avx512(Mobility mobility, int degree) {
  return choose_near<float, 2>(mobility, degree);
}

template <>
SumNear<float, 3> sum_near_avx512(Mobility mobility, int degree) {
  return choose_near<float, 3>(mobility, degree);
}

template <>
SumNear<double, 2> sum_near_avx512(Mobility mobility, int degree) {
  return choose_near<double, 2>(mobility, degree);
}

template <>
SumNear<double, 3> sum_near_avx512(Mobility mobility, int degree) {
  return choose_near<double, 3>(mobility, degree);
}

}  // namespace talus::cloud
