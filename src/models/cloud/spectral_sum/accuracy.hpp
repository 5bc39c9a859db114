// SPDX-License-Identifier: Apache-2.0
/// The accuracies for which the spectral sum is set up, and what was measured of each.
#pragma once

namespace talus::cloud {

/// Lengths in units of the cut-off r_c.
struct SpectralAccuracy {
  double error;  ///< root mean square of the error over that of the sums
  double
      pair_error;  ///< bound of |error of 8 pi mu M_ij| times max(r, r_c), for every pair and for i = j, but rounding
  double beta;     ///< of the window (split.hpp)
  int order;       ///< m of the window
  int points;      ///< nodes of the grid over which a sphere is spread, in each direction: the order of the B-spline
  double nodes;    ///< of the grid in the length of the cut-off
  int seam;        ///< nodes between the doubled grid's seam, where the sampled tensor has an edge, and what is summed
  int degree;      ///< of the polynomials in place of the smooth part
  bool single;     ///< arithmetic in single precision; positions are in double precision anyway
};

inline constexpr SpectralAccuracy spectral_accuracies[] = {
    {1e-3, 2.5e-2, 6.5, 2, 4, 4.5, 8, 7, true},
    {1e-4, 6e-4, 9.0, 3, 6, 6, 24, 9, true},
    {1e-5, 5e-5, 12.0, 3, 8, 8, 64, 12, false},
};

/// Rounding of a pair, over |M_ij| r_c/r: places of near spheres are rounded at the scale of the cut-off.
constexpr double pair_rounding(const SpectralAccuracy& accuracy) {
  return accuracy.single ? 2e-6 : 1e-14;
}

/// The least accurate one whose error is at most this; nothing below the error of the last.
constexpr const SpectralAccuracy* spectral_accuracy(double error) {
  for (const SpectralAccuracy& accuracy : spectral_accuracies)
    if (accuracy.error <= error) return &accuracy;
  return nullptr;
}

}  // namespace talus::cloud
