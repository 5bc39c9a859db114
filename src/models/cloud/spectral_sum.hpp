// SPDX-License-Identifier: Apache-2.0
/// The sum over all pairs of spheres in a plane or in space at a cost of N log N: the tensor is split
/// (spectral_sum/split.hpp) into a smooth part, summed on a grid by Fourier transforms, and a rest that near pairs
/// alone have, summed directly.
///
/// Unequal radii, coplanar positions and unbounded space are exact; what errs is the grid (and single precision). For
/// every position of the spheres and all forces,
///     |error of velocity i| <= k/(8 pi mu) sum over j of |F_j| / max(r_ij, r_c),   j = i included,
/// with k the `pair_error` of the accuracy and r_c the cut-off, and the rounding of near pairs, `pair_rounding`. Errors
/// of pairs have no common sign: over clouds their root mean square is below `error` times the sums' root mean square:
/// docs/design/cloud-sums.md.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "base/vector.hpp"
#include "models/cloud/pair_sum.hpp"

namespace talus::cloud {

// The accuracies for which the spectral sum is set up, and what was measured of each.

/// Lengths in units of the cut-off r_c.
struct SpectralAccuracy {
  double error;  ///< root mean square of the error over the same of the sums
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

/// Rounding of a pair, over |M_ij| r_c/r: positions of near spheres are rounded at the scale of the cut-off.
constexpr double pair_rounding(const SpectralAccuracy& accuracy) {
  return accuracy.single ? 2e-6 : 1e-14;
}

/// The least accurate one whose error is at most this; nothing below the error of the last.
constexpr const SpectralAccuracy* spectral_accuracy(double error) {
  for (const SpectralAccuracy& accuracy : spectral_accuracies)
    if (accuracy.error <= error) return &accuracy;
  return nullptr;
}

/// What a sum by the split costs at some positions of spheres, and by pairs; in units of about a second of a core.
struct SpectralPlan {
  double cutoff = 0;  ///< m, the cheapest
  double cost = 0;
  double direct_cost = 0;
};

class SpectralSum {
 public:
  using Options = PairSum::Options;

  /// \param options with a mobility other than `none`; the precision follows from the accuracy
  /// \param radius one per sphere, m, > 0
  /// \throws std::invalid_argument for no mobility; InputError as PairSum
  SpectralSum(const Options& options, const SpectralAccuracy& accuracy, std::span<const double> radius);
  ~SpectralSum();
  SpectralSum(SpectralSum&&) noexcept;
  SpectralSum& operator=(SpectralSum&&) noexcept;

  /// The order in which the spheres are gone through, as PairSum's.
  void reorder(std::span<const std::uint32_t> order);

  /// The cheapest cut-off for these positions, of those whose grid has room; nothing if the positions are not finite.
  std::optional<SpectralPlan> plan(std::span<const Vector3> position) const;

  /// The distance beyond which pairs go by the grid alone. The lattice of the grid is fixed in space by it: the bits
  /// depend on the cut-off, the positions and the order, and on no other history.
  /// \param cutoff m, > 0, at least min_cutoff()
  void set_cutoff(double cutoff);
  double cutoff() const;
  double min_cutoff() const;

  /// As PairSum's, within the error above, and bitwise identical for any number of threads.
  /// \returns false, with velocities left as they were, if the spheres are so far apart that a grid over them would
  ///          have more than `max_nodes`
  bool velocities(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                  std::span<Vector3> velocity);

  static constexpr double max_nodes = 8e6;

  class Engine;

 private:
  std::unique_ptr<Engine> engine_;
};

}  // namespace talus::cloud
