// SPDX-License-Identifier: Apache-2.0
/// The sums of a particle at a wall, compiled for one instruction set.
#include "models/continuum/boundary/kernels/sum_walls.hpp"

namespace talus::continuum {

WallKernels wall_kernels_avx512() {
  return {sum_points, sum_images};
}

}  // namespace talus::continuum
