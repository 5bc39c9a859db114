// SPDX-License-Identifier: Apache-2.0
/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952; Saad 2003, Iterative Methods for Sparse Linear Systems,
/// algorithm 9.1) for a symmetric matrix A. The storage of the columns, the order of their sums and M are up to the
/// system and the preconditioner; the order must not depend on the number of threads.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

namespace talus {

/// Columns x, r = b - A x, and the direction d.
template <class S>
concept LinearSystem = requires(S system, double step) {
  { system.residual_square() } -> std::same_as<double>;     // r . r
  { system.apply_to_direction() } -> std::same_as<double>;  // q := A d; returns d . q
  system.advance(step);                                     // x += step d, r -= step q
};

/// M, near the inverse of A, symmetric.
template <class P>
concept Preconditioner = requires(P preconditioner, double norm, double beta) {
  { preconditioner.apply(norm) } -> std::same_as<double>;  // z := M r, where |r| = norm; returns r . z
  preconditioner.update_direction(beta);                   // d := z + beta d
};

enum class Convergence { reached, too_slow, not_finite };

struct ConjugateGradients {
  Convergence convergence;
  int iterations;
  double residual;  ///< |r|
};

/// Iterates until |r| <= enough, from the x, r and d = 0 that the system has.
template <LinearSystem S, Preconditioner P>
ConjugateGradients solve_by_conjugate_gradients(S& system, P& preconditioner, double enough, int max_iterations) {
  double before = 0;
  for (int iteration = 0;; ++iteration) {
    const double norm = std::sqrt(system.residual_square());
    if (norm <= enough) return {Convergence::reached, iteration, norm};
    if (!(norm <= std::numeric_limits<double>::max())) return {Convergence::not_finite, iteration, norm};
    if (iteration == max_iterations) return {Convergence::too_slow, iteration, norm};
    const double product = preconditioner.apply(norm);
    preconditioner.update_direction(before > 0 ? product / before : 0);
    before = product;
    system.advance(product / system.apply_to_direction());
  }
}

}  // namespace talus
