// SPDX-License-Identifier: Apache-2.0
/// B-splines, by which spheres are spread over the nodes of a grid and fields taken from them.
/// Source: de Boor, J. Approx. Theory 6, 50 (1972), on a uniform grid.
#pragma once

#include <cmath>
#include <numbers>

namespace talus::cloud {

/// Values at the nodes floor(x) - order/2 + 1 + k of the spline of even order about x, and their derivatives with
/// respect to x; lengths in spacings of the grid.
template <class T, int order>
struct SplineWeights {
  T value[order];
  T slope[order];

  /// \param t x - floor(x)
  explicit SplineWeights(T t) {
    value[0] = 1 - t, value[1] = t;
    for (int n = 3; n <= order; ++n) {
      if (n == order) {
        slope[0] = -value[0], slope[order - 1] = value[order - 2];
        for (int k = 1; k < order - 1; ++k) slope[k] = value[k - 1] - value[k];
      }
      const T scale = T(1) / T(n - 1);
      value[n - 1] = scale * t * value[n - 2];
      for (int k = n - 2; k > 0; --k)
        value[k] = scale * ((t + T(n - 1 - k)) * value[k - 1] + (T(k + 1) - t) * value[k]);
      value[0] *= scale * (1 - t);
    }
  }
};

/// What a spectrum is multiplied with to undo that it was spread and will be interpolated by the spline: the factor
/// with the least mean square error over all positions of source and target for a spectrum without aliases,
///     w(k)^2 / (sum over m of w(k + 2 pi m)^2)^2,  w(k) = [sin(k/2)/(k/2)]^order.
/// Source: Hockney & Eastwood, Computer Simulation Using Particles (1981), section 8-3.
/// \param k wave number times the spacing, at most pi
inline double spline_correction(double k, int order) {
  const auto spectrum = [&](double x) { return x == 0 ? 1.0 : std::pow(std::sin(0.5 * x) / (0.5 * x), order); };
  double sum = 0;
  for (int m = -8; m <= 8; ++m) sum += std::pow(spectrum(k + 2 * std::numbers::pi * m), 2);
  return std::pow(spectrum(k) / sum, 2);
}

}  // namespace talus::cloud
