// SPDX-License-Identifier: Apache-2.0
/// Velocity gradients of all particles, a column for each component.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/tensor.hpp"

namespace talus::continuum {

struct GradientColumns {
  std::array<std::vector<double>, 9> component;  ///< du_i/dx_j, 1/s: xx xy xz yx yy yz zx zy zz

  void resize(std::size_t count) {
    for (auto& column : component) column.resize(count);
  }
  std::size_t size() const { return component[0].size(); }
  Tensor3<> operator[](std::size_t i) const {
    const auto& c = component;
    return {c[0][i], c[1][i], c[2][i], c[3][i], c[4][i], c[5][i], c[6][i], c[7][i], c[8][i]};
  }
};

}  // namespace talus::continuum
