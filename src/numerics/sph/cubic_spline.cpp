// SPDX-License-Identifier: Apache-2.0

#include "numerics/sph/cubic_spline.hpp"
#include "base/clones.hpp"

namespace talus::sph {

namespace {

/// \returns whether the numbers are all such as normal_cube_root() takes
TALUS_CLONES bool find_lengths(std::size_t count, double mass, double ratio, const double* density,
                               double* __restrict length) {
  std::uint64_t strange = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double volume = mass / density[i];
    strange |= is_normal_and_positive(volume) ? 0 : 1;
    length[i] = ratio * normal_cube_root(volume);
  }
  return strange == 0;
}

}  // namespace

void smoothing_lengths(std::size_t count, double mass, double ratio, const double* density, double* length) {
  if (find_lengths(count, mass, ratio, density, length)) return;
  for (std::size_t i = 0; i < count; ++i) length[i] = ratio * smoothing_length(mass, density[i]);
}

}  // namespace talus::sph
